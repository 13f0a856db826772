// The bundled extension with a mock editor and the real language server, whose command MSAA_LINT names.
const assert = require("node:assert/strict");
const { mkdtempSync, writeFileSync } = require("node:fs");
const Module = require("node:module");
const { tmpdir } = require("node:os");
const { join } = require("node:path");
const { after, test } = require("node:test");

const resolve = Module._resolveFilename;
Module._resolveFilename = (name, ...rest) => (name === "vscode" ? require.resolve("./vscode.cjs") : resolve(name, ...rest));
const vscode = require("./vscode.cjs");
const extension = require("../out/extension.js");
const { mock } = vscode;

const COMMAND = process.env.MSAA_LINT ?? "msaa-lint";
const TEXT = `images:
  color_ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT]}
renderPasses:
  forward:
    attachments:
      color_ms: {image: color_ms, loadOp: CLEAR, storeOp: STORE}
      color: {format: R8G8B8A8_UNORM, samples: 1, loadOp: DONT_CARE, storeOp: STORE}
    subpasses:
      - {colorAttachments: [color_ms], resolveAttachments: [color]}
commands:
  - beginRenderPass: {renderPass: forward}
  - endRenderPass
`;
const LINE = 5;

/** An open document of the editor. */
function documentOf(uri, text) {
    const lines = text.split("\n");
    return {
        uri,
        fileName: uri.fsPath,
        languageId: "yaml",
        version: 1,
        isClosed: false,
        lineCount: lines.length,
        getText: () => text,
        lineAt: (line) => ({ text: lines[line] }),
    };
}

async function opened(name) {
    const folder = mkdtempSync(join(tmpdir(), "msaa-lint-vscode-"));
    writeFileSync(join(folder, name), TEXT);
    const document = documentOf(vscode.Uri.file(join(folder, name)), TEXT);
    vscode.workspace.textDocuments.push(document);
    const tab = new vscode.TabInputText();
    tab.uri = document.uri;
    vscode.window.tabGroups.all.push({ tabs: [{ input: tab }] });
    vscode.window.activeTextEditor = { document };
    await mock.emitters.onDidOpenTextDocument.fire(document);
    await mock.emitters.onDidChangeTabs.fire({ opened: [{ input: tab }], changed: [], closed: [] });
    return document;
}

/** The next diagnostics of a document that are not empty. */
function diagnosed(document) {
    const uri = document.uri.toString();
    return new Promise((resolve) => {
        const look = () => mock.diagnostics.get(uri)?.length && resolve(mock.diagnostics.get(uri));
        mock.changedDiagnostics.event(look);
        look();
    });
}

/** The next message to the user. */
const shown = () => new Promise((resolve) => mock.shown.event(resolve));

/** The setting changes, and the extension hears of it. */
async function set(name, value) {
    mock.settings[`msaaLint.${name}`] = value;
    await mock.emitters.onDidChangeConfiguration.fire({ affectsConfiguration: (other) => other === `msaaLint.${name}` });
}

after(() => extension.deactivate());

test("a missing command is named, with what to do", { timeout: 60_000 }, async () => {
    mock.settings["msaaLint.path"] = "/nowhere/msaa-lint";
    const message = shown();
    await extension.activate({ subscriptions: [] });
    assert.match(await message, /^The command `\/nowhere\/msaa-lint` was not found\. Install msaa-lint with its extra `lsp`, or set `msaaLint\.path`\.$/);
});

test("why the server ended is shown", { timeout: 60_000 }, async () => {
    mock.settings["msaaLint.arguments"] = ["--no-such-option"];
    const message = shown();
    await set("path", COMMAND);
    assert.match(await message, /^msaa-lint: .*--no-such-option/);
    assert.equal(mock.messages.length, 2, "one for each failure");
});

test("diagnostics of an open description arrive", { timeout: 20_000 }, async () => {
    mock.messages.length = 0;
    await set("arguments", []);
    const found = await diagnosed(await opened("frame.msaa.yaml"));
    assert.deepEqual(mock.messages, []);
    const stored = found.find((one) => (one.code.value ?? one.code) === "MSAA201");
    assert.ok(stored, JSON.stringify(found));
    assert.equal(stored.range.start.line, LINE);
    assert.equal(TEXT.split("\n")[LINE].slice(stored.range.start.character, stored.range.end.character), "STORE");
});

test("a restart diagnoses the open documents again", { timeout: 20_000 }, async () => {
    mock.diagnostics.clear();
    await mock.registered["msaaLint.restart"]();
    assert.ok((await diagnosed(vscode.workspace.textDocuments[0])).length);
});

test("the command for fixes asks for a kind of action that the server has, whose edit fixes the text", { timeout: 60_000 }, async () => {
    await mock.registered["msaaLint.fixAll"]();
    const [command, asked] = mock.executed.at(-1);
    assert.equal(command, "editor.action.codeAction");
    assert.equal(asked.apply, "first");
    assert.ok(mock.codeActions.kinds.includes(asked.kind), mock.codeActions.kinds.join());

    const [document] = vscode.workspace.textDocuments;
    const only = asked.kind.split(".").reduce((kind, part) => kind.append(part), vscode.CodeActionKind.Empty);
    const { token } = new vscode.CancellationTokenSource();
    const { provider } = mock.codeActions;
    const [found] = await provider.provideCodeActions(document, new vscode.Range(0, 0, 0, 0), { only, diagnostics: [], triggerKind: 1 }, token);
    const action = found.edit ? found : await provider.resolveCodeAction(found, token);
    const [[range, text], ...others] = action.edit.edits.map((edit) => edit.values);
    assert.deepEqual(others, []);
    assert.equal(range.start.line, LINE);
    assert.match(text, /\bDONT_CARE\b/);
});

test("a server that is not enabled does not run", { timeout: 60_000 }, async () => {
    await set("enable", false);
    assert.equal(mock.diagnostics.size, 0);
    assert.deepEqual(mock.messages, [], "no end that was asked for is a failure");
});
