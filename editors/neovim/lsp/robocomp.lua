-- Neovim 0.11 and later: the configuration that `vim.lsp.enable('robocomp')` reads.

local robocomp = require('robocomp')

return {
  filetypes = robocomp.filetypes,
  cmd = function(dispatchers, config)
    local command = robocomp.command(config.root_dir)
    return vim.lsp.rpc.start(command, dispatchers, { cwd = config.root_dir })
  end,
  root_dir = function(buffer, found)
    local root = robocomp.root(buffer)
    if not root then
      return
    end
    if robocomp.command(root) then
      found(root)
    else
      robocomp.report_missing()
    end
  end,
}
