-- Loaded when Neovim starts: has the language server started for the files of RoboComp.

local robocomp = require('robocomp')
local group = vim.api.nvim_create_augroup('robocomp', { clear = true })

local function on_file(types, what)
  vim.api.nvim_create_autocmd('FileType', {
    group = group,
    pattern = types,
    callback = function(event)
      what(event.buf)
    end,
  })
end

on_file(robocomp.languages, function(buffer)
  vim.bo[buffer].commentstring = '// %s'
end)

if vim.lsp.config then
  vim.lsp.enable('robocomp')
else
  on_file(robocomp.filetypes, robocomp.attach)
end
