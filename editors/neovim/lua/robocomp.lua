-- Shared by all Neovim versions: languages, project folders, server command.
-- In: a buffer. Out: its language, the folder of its project, the command of its server.

local M = {}

M.languages = { 'idsl', 'cdsl', 'pdsl', 'ddsl', 'smdsl', 'bdsl' }
M.filetypes = vim.list_extend({ 'xml' }, M.languages)

-- The project of a file is the nearest folder above it that contains one of these.
M.markers = { '.venv', '.git', 'pyproject.toml' }

local MISSING = 'RoboComp: `rcgen` was not found: neither in a .venv of this project nor on the PATH. '
  .. "Install it with `pip install 'robocomp_dsl[editor]'`, "
  .. "or set its path: vim.g.robocomp_server = '/path/to/rcgen'"

-- An XML file is supported if it is SCXML, or its root element is `<innerModel>`.
local function is_supported(buffer)
  if vim.bo[buffer].filetype ~= 'xml' then
    return true
  end
  if vim.api.nvim_buf_get_name(buffer):find('%.scxml$') then
    return true
  end
  local head = table.concat(vim.api.nvim_buf_get_lines(buffer, 0, 50, false), '\n')
  return head:find('<innerModel', 1, true) ~= nil
end

-- The project folder of `buffer`, or nil if its language is not supported.
function M.root(buffer)
  local name = vim.api.nvim_buf_get_name(buffer)
  if name == '' or not is_supported(buffer) then
    return nil
  end
  local start = vim.fn.fnamemodify(name, ':p:h')
  local folder, above = start, nil
  while folder ~= above do
    for _, marker in ipairs(M.markers) do
      if vim.fn.getftype(folder .. '/' .. marker) ~= '' then
        return folder
      end
    end
    folder, above = vim.fn.fnamemodify(folder, ':h'), folder
  end
  return start
end

-- The command of the language server: the one set, the project's own, or the one on the PATH.
function M.command(root)
  local programs = vim.g.robocomp_server and { vim.g.robocomp_server }
    or { root .. '/.venv/bin/rcgen', root .. '/.venv/Scripts/rcgen.exe', 'rcgen' }
  for _, program in ipairs(programs) do
    if vim.fn.executable(program) == 1 then
      return { program, 'lsp' }
    end
  end
  return nil
end

-- Reports a missing server once, with how to install it.
function M.report_missing()
  if not M.missing_reported then
    M.missing_reported = true
    vim.notify(MISSING, vim.log.levels.WARN)
  end
end

-- Neovim 0.7 to 0.10: attach the buffer to the server of its project; starts the server if necessary.
function M.attach(buffer)
  local root = M.root(buffer)
  if not root then
    return
  end
  local command = M.command(root)
  if not command then
    return M.report_missing()
  end
  local config = { name = 'robocomp', cmd = command, root_dir = root }
  if vim.lsp.start then
    vim.lsp.start(config, { bufnr = buffer })
    return
  end
  config.workspace_folders = { { uri = vim.uri_from_fname(root), name = root } }
  M.clients = M.clients or {}
  local id = M.clients[root]
  if not (id and vim.lsp.get_client_by_id(id)) then
    id = vim.lsp.start_client(config)
    M.clients[root] = id
  end
  if id then
    vim.lsp.buf_attach_client(buffer, id)
  end
end

return M
