-- Loaded when Neovim starts: enables the language server for RoboComp's files.

local robocomp = require('robocomp')
local group = vim.api.nvim_create_augroup('robocomp', { clear = true })

local function on_file(types, handler)
  vim.api.nvim_create_autocmd('FileType', {
    group = group,
    pattern = types,
    callback = function(event)
      handler(event.buf)
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
