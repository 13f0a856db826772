// As much of the module `vscode` as the extension and vscode-languageclient use: events that a test fires, and calls that it can look at.
const { pathToFileURL, fileURLToPath } = require("node:url");

class EventEmitter {
    #listeners = new Set();
    event = (listener, self) => {
        const bound = self ? listener.bind(self) : listener;
        this.#listeners.add(bound);
        return { dispose: () => this.#listeners.delete(bound) };
    };
    fire(value) {
        return Promise.all([...this.#listeners].map((listener) => listener(value)));
    }
    dispose() {}
}

class Disposable {
    constructor(dispose) {
        this.dispose = dispose ?? (() => {});
    }
    static from(...all) {
        return new Disposable(() => all.forEach((one) => one.dispose()));
    }
}

class Uri {
    constructor(text) {
        this.text = text;
        this.scheme = text.split(":")[0];
        this.path = new URL(text).pathname;
        this.authority = this.query = this.fragment = "";
    }
    get fsPath() {
        return fileURLToPath(this.text);
    }
    toString() {
        return this.text;
    }
    with() {
        return this;
    }
    static parse(text) {
        return new Uri(text);
    }
    static file(path) {
        return new Uri(pathToFileURL(path).href);
    }
}

class Position {
    constructor(line, character) {
        Object.assign(this, { line, character });
    }
}

class Range {
    constructor(...at) {
        [this.start, this.end] = at.length === 4 ? [new Position(at[0], at[1]), new Position(at[2], at[3])] : at;
    }
}

/** A class that keeps what it is constructed with. */
const kept = () =>
    class {
        constructor(...values) {
            this.values = values;
        }
    };

class Diagnostic {
    constructor(range, message, severity) {
        Object.assign(this, { range, message, severity });
    }
}

class CodeActionKind {
    constructor(value) {
        this.value = value;
    }
    append(part) {
        return new CodeActionKind(this.value ? `${this.value}.${part}` : part);
    }
    static Empty = new CodeActionKind("");
}
for (const kind of ["QuickFix", "Refactor", "Source"]) CodeActionKind[kind] = new CodeActionKind(kind.toLowerCase());

class CodeAction {
    constructor(title, kind) {
        Object.assign(this, { title, kind });
    }
}

class WorkspaceEdit {
    edits = [];
    set(uri, edits) {
        this.edits.push(...edits.flat().filter((edit) => edit?.values));
    }
}

class CancellationTokenSource {
    token = { isCancellationRequested: false, onCancellationRequested: () => new Disposable() };
    cancel() {}
    dispose() {}
}

const emitters = {};
/** An event by its name, which the test fires as `mock.emitters.NAME`. */
const event = (name) => (emitters[name] ??= new EventEmitter()).event;

/** An object whose unknown `onDid...` are events and whose other unknown members are functions that return something to dispose of. */
const open = (members) =>
    new Proxy(members, {
        get: (target, name) => {
            if (name in target || typeof name === "symbol") return target[name];
            return name.startsWith("onDid") || name.startsWith("onWill") ? event(name) : () => new Disposable();
        },
    });

const mock = {
    settings: {},
    registered: {},
    executed: [],
    messages: [],
    shown: new EventEmitter(),
    diagnostics: new Map(),
    changedDiagnostics: new EventEmitter(),
    lines: [],
    emitters,
};

async function show(message) {
    mock.messages.push(message);
    await mock.shown.fire(message);
}

const log = (...values) => void mock.lines.push(values.join(" "));

function collection() {
    const entries = new Map();
    return {
        entries,
        set: (uri, values) => {
            mock.diagnostics.set(uri.toString(), values ?? []);
            void mock.changedDiagnostics.fire(uri.toString());
        },
        delete: (uri) => mock.diagnostics.delete(uri.toString()),
        has: (uri) => mock.diagnostics.has(uri.toString()),
        clear: () => mock.diagnostics.clear(),
        dispose: () => mock.diagnostics.clear(),
    };
}

/** Whether a document is of a filter's scheme and language; patterns are not matched. */
function matches(selector, document) {
    const filters = Array.isArray(selector) ? selector : [selector];
    const is = (filter) => !filter.pattern && filter.language === document.languageId && (filter.scheme ?? document.uri.scheme) === document.uri.scheme;
    return filters.some(is) ? 10 : 0;
}

module.exports = new Proxy(
    {
        mock,
        EventEmitter,
        Disposable,
        Uri,
        Position,
        Range,
        Diagnostic,
        CodeActionKind,
        CodeAction,
        WorkspaceEdit,
        CancellationTokenSource,
        CancellationError: class extends Error {},
        version: "1.91.0",
        DiagnosticSeverity: { Error: 0, Warning: 1, Information: 2, Hint: 3 },
        DiagnosticTag: { Unnecessary: 1, Deprecated: 2 },
        StatusBarAlignment: { Left: 1, Right: 2 },
        env: open({ language: "en", appName: "test", uriScheme: "vscode" }),
        workspace: open({
            workspaceFolders: [],
            textDocuments: [],
            notebookDocuments: [],
            getConfiguration: (section) => ({
                get: (name, value) => mock.settings[section ? `${section}.${name}` : name] ?? value,
                has: () => false,
                inspect: () => undefined,
            }),
            getWorkspaceFolder: () => undefined,
            createFileSystemWatcher: () => open({ dispose: () => {} }),
            fs: { isWritableFileSystem: () => true },
        }),
        window: open({
            activeTextEditor: undefined,
            visibleTextEditors: [],
            tabGroups: open({ all: [] }),
            createOutputChannel: (name) =>
                open({ name, logLevel: 3, trace: log, debug: log, info: log, warn: log, error: log, append: log, appendLine: log, show: () => log("shown") }),
            showErrorMessage: show,
            showWarningMessage: show,
            showInformationMessage: show,
        }),
        languages: open({
            createDiagnosticCollection: collection,
            match: matches,
            getDiagnostics: () => [],
            registerCodeActionsProvider: (selector, provider, metadata) => {
                mock.codeActions = { provider, kinds: metadata.providedCodeActionKinds.map((kind) => kind.value) };
                return new Disposable();
            },
        }),
        commands: open({
            registerCommand: (name, action) => {
                mock.registered[name] = action;
                return new Disposable(() => delete mock.registered[name]);
            },
            executeCommand: async (...call) => void mock.executed.push(call),
        }),
        extensions: open({ all: [] }),
        lm: open({}),
    },
    { get: (target, name) => (name in target || typeof name === "symbol" ? target[name] : (target[name] = kept())) },
);
