-- Run inside Neovim: opens files and asks for what a user sees. Written out: one JSON object.
-- Expects the environment variable RESULT, the file to write, and the working folder of the project.

local WAIT_MS = 60000
local result = {}

local function wait(what, condition)
  assert(vim.wait(WAIT_MS, condition, 20), 'never happened: ' .. what)
end

local function open(name)
  vim.cmd('edit ' .. name)
  return vim.api.nvim_get_current_buf()
end

local function clients(buffer)
  local get = vim.lsp.get_clients or function(filter)
    return vim.tbl_values(vim.lsp.buf_get_clients(filter.bufnr))
  end
  return get({ bufnr = buffer })
end

local function ready(buffer)
  wait('client of ' .. vim.api.nvim_buf_get_name(buffer), function()
    local all = clients(buffer)
    return #all > 0 and all[1].initialized ~= nil and all[1].initialized
  end)
  return clients(buffer)[1]
end

local function findings(name)
  local buffer = open(name)
  wait('findings in ' .. name, function()
    return #vim.diagnostic.get(buffer) > 0
  end)
  local found = {}
  for _, one in ipairs(vim.diagnostic.get(buffer)) do
    table.insert(found, { one.lnum, one.col, one.message })
  end
  return found
end

-- Puts the cursor on the n-th character of the first `word` after which a request is answered.
local function at(buffer, word, into)
  for number, line in ipairs(vim.api.nvim_buf_get_lines(buffer, 0, -1, false)) do
    local column = line:find(word, 1, true)
    if column then
      vim.api.nvim_win_set_cursor(0, { number, column - 1 + (into or 0) })
      return
    end
  end
  error(word .. ' is not in the buffer')
end

local function place()
  local cursor = vim.api.nvim_win_get_cursor(0)
  local name = vim.fn.fnamemodify(vim.api.nvim_buf_get_name(0), ':t')
  return { name, cursor[1] - 1, cursor[2] }
end

local function ask(buffer, method, more)
  local cursor = vim.api.nvim_win_get_cursor(0)
  local params = vim.tbl_extend('force', {
    textDocument = { uri = vim.uri_from_bufnr(buffer) },
    position = { line = cursor[1] - 1, character = cursor[2] },
  }, more or {})
  local answers = assert(vim.lsp.buf_request_sync(buffer, method, params, WAIT_MS), method)
  local _, answer = next(answers)
  assert(answer and not answer.err, vim.inspect(answer))
  return answer.result
end

local function all_findings()
  result.findings = {}
  for _, name in ipairs({ 'wrong.cdsl', 'wrong.idsl', 'wrong.pdsl', 'wrong.ddsl', 'wrong.xml', 'wrong.scxml' }) do
    result.findings[name] = findings(name)
  end
end

local function definition(buffer)
  at(buffer, 'requires Laser', #'requires ')
  vim.lsp.buf.definition()
  wait('the jump to the definition', function()
    return place()[1] == 'Laser.idsl'
  end)
  result.definition = place()
end

local function rename()
  local buffer = vim.api.nvim_get_current_buf()
  ready(buffer)
  at(buffer, 'interface Laser', #'interface ')
  vim.lsp.buf.rename('Lidar')
  wait('the new name', function()
    return vim.api.nvim_buf_get_lines(buffer, 6, 7, false)[1]:find('Lidar') ~= nil
  end)
  result.renamed = {}
  for _, one in ipairs(vim.api.nvim_list_bufs()) do
    local name = vim.fn.fnamemodify(vim.api.nvim_buf_get_name(one), ':t')
    if vim.api.nvim_buf_is_loaded(one) then
      result.renamed[name] = vim.api.nvim_buf_get_lines(one, 0, -1, false)
    end
  end
end

local function complete(buffer)
  vim.api.nvim_buf_set_lines(buffer, 4, 5, false, { '    Communications { requires ; };' })
  vim.api.nvim_win_set_cursor(0, { 5, #'    Communications { requires ' })
  local answer = ask(buffer, 'textDocument/completion')
  result.completion = {}
  for _, one in ipairs(answer.items or answer) do
    table.insert(result.completion, one.label)
  end
  vim.cmd('undo')
end

local function format(client)
  local offers = client.server_capabilities or client.resolved_capabilities
  if not (offers.documentFormattingProvider or offers.document_formatting) then
    return
  end
  local buffer = open('ugly.cdsl')
  ready(buffer)
  if vim.lsp.buf.format then
    vim.lsp.buf.format({ async = false, timeout_ms = WAIT_MS })
  else
    vim.lsp.buf.formatting_sync(nil, WAIT_MS)
  end
  result.formatted = vim.api.nvim_buf_get_lines(buffer, 0, -1, false)
end

local function everything()
  result.version = { vim.version().major, vim.version().minor }
  all_findings()
  local buffer = open('reader.cdsl')
  local client = ready(buffer)
  result.encoding = client.offset_encoding
  at(buffer, 'requires Laser', #'requires ')
  result.hover = ask(buffer, 'textDocument/hover').contents.value
  complete(buffer)
  definition(buffer)
  format(client)
  open('Laser.idsl')
  rename()
end

local fine, failure = xpcall(everything, debug.traceback)
result.failure = not fine and failure or nil
local out = assert(io.open(vim.env.RESULT, 'w'))
out:write(vim.fn.json_encode(result))
out:close()
vim.cmd('qall!')
