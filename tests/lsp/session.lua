-- Opens a file in Neovim, waits for its diagnostics, applies a code action, formats, and writes what it sees as JSON.
-- SERVER is the command of the server, FILE the file, REPORT where to write.
local report = { errors = {} }
vim.ui.select = function(items, _, choose)
  choose(items[1])
end
vim.lsp.handlers["window/showMessage"] = function(_, message)
  table.insert(report.errors, message.message)
end

local function messages()
  return vim.tbl_map(function(each)
    return { code = each.code or each.user_data and each.user_data.lsp.code, line = each.lnum, column = each.col, message = each.message }
  end, vim.diagnostic.get(0))
end

vim.cmd("edit " .. vim.env.FILE)
local client = vim.lsp.start_client({ name = "msaa-lint", cmd = vim.split(vim.env.SERVER, " "), root_dir = vim.fn.getcwd() })
vim.lsp.buf_attach_client(0, client)
vim.wait(60000, function() return #vim.diagnostic.get(0) > 0 end, 20)
report.before = messages()

vim.api.nvim_win_set_cursor(0, { report.before[1].line + 1, report.before[1].column })
vim.lsp.buf.code_action({ only = { "source.fixAll" }, diagnostics = {} })
vim.wait(60000, function() return #vim.diagnostic.get(0) == 0 end, 20)
report.after = messages()
report.text = table.concat(vim.api.nvim_buf_get_lines(0, 0, -1, true), "\n") .. "\n"

-- The cursor stays in its word, which formatting moves.
local function blanks(line)
  return (line:gsub("^ +", "%0%0"):gsub(": ", ":   "))
end
local lines = vim.tbl_map(blanks, vim.api.nvim_buf_get_lines(0, 0, -1, true))
vim.api.nvim_buf_set_lines(0, 0, -1, true, lines)
vim.fn.search("storeOp")
if vim.lsp.buf.format then vim.lsp.buf.format({ timeout_ms = 60000 }) else vim.lsp.buf.formatting_sync(nil, 60000) end
report.formatted = table.concat(vim.api.nvim_buf_get_lines(0, 0, -1, true), "\n") .. "\n"
report.word = vim.fn.expand("<cword>")

local file = assert(io.open(vim.env.REPORT, "w"))
file:write(vim.fn.json_encode(report))
file:close()
vim.lsp.stop_client(client)
vim.wait(5000, function() return vim.lsp.client_is_stopped(client) end, 20)
vim.cmd("qall!")
