-- Sets the file types of RoboComp's files. (`vim.filetype.add` does not exist in Neovim 0.7.)

vim.api.nvim_create_autocmd({ 'BufRead', 'BufNewFile' }, {
  pattern = { '*.idsl', '*.cdsl', '*.pdsl', '*.ddsl', '*.smdsl', '*.bdsl' },
  callback = function(event)
    vim.bo[event.buf].filetype = vim.fn.fnamemodify(event.match, ':e')
  end,
})

vim.api.nvim_create_autocmd({ 'BufRead', 'BufNewFile' }, {
  pattern = '*.scxml',
  callback = function(event)
    vim.bo[event.buf].filetype = 'xml'
  end,
})
