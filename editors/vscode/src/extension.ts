// The extension: runs the language server of the installed msaa-lint, and restarts it when its settings change.
import { commands, type ExtensionContext, type LogOutputChannel, window, workspace } from "vscode";
import { CloseAction, type DocumentSelector, ErrorAction, LanguageClient, RevealOutputChannelOn } from "vscode-languageclient/node";
import { ServerProcess, settings } from "./server";

const LANGUAGES = ["yaml", "json", "jsonc", "c", "cpp", "cuda-cpp", "objective-c", "objective-cpp", "rust", "swift", "glsl"];
/** Files without a language of their own in every editor: configurations, rule pages, and source code. The server looks at what they contain. */
const PATTERNS = ["**/{msaa-lint,pyproject}.toml", "**/*.md", "**/*.{glsl,vert,frag,comp,tesc,tese,geom,mesh,task}", "**/*.{rs,swift}"];
/** Starts of a server that keeps ending. */
const MAX_PROCESSES = 4;

let client: LanguageClient | undefined;
let output: LogOutputChannel;
/** Starts and stops follow one another. */
let pending: Promise<void> = Promise.resolve();

export function selector(): DocumentSelector {
    const schemes = ["file", "untitled"];
    return [
        ...schemes.flatMap((scheme) => LANGUAGES.map((language) => ({ scheme, language }))),
        ...PATTERNS.map((pattern) => ({ scheme: "file", pattern })),
    ];
}

export async function activate(context: ExtensionContext): Promise<void> {
    output = window.createOutputChannel("msaa-lint", { log: true });
    context.subscriptions.push(
        output,
        commands.registerCommand("msaaLint.restart", restart),
        commands.registerCommand("msaaLint.showOutput", () => output.show()),
        commands.registerCommand("msaaLint.fixAll", () =>
            commands.executeCommand("editor.action.codeAction", { kind: "source.fixAll.msaaLint", apply: "first" }),
        ),
        workspace.onDidChangeConfiguration(async (event) => {
            if (["enable", "path", "arguments"].some((name) => event.affectsConfiguration(`msaaLint.${name}`))) await restart();
        }),
    );
    await restart();
}

export function deactivate(): Promise<void> {
    return queued(stop);
}

function restart(): Promise<void> {
    return queued(async () => {
        await stop();
        if (settings().enable) await start();
    });
}

function queued(action: () => Promise<void>): Promise<void> {
    pending = pending.then(action, action);
    return pending;
}

async function stop(): Promise<void> {
    const ending = client;
    client = undefined;
    await ending?.dispose().catch((error: unknown) => output.warn(`The language server did not stop: ${error}`));
}

/** A client that leaves it to the extension what the user is told: its own messages have the trace of its calls. */
class Client extends LanguageClient {
    override error(message: string, data?: unknown): void {
        super.error(message, data, false);
    }
}

async function start(): Promise<void> {
    let server: ServerProcess;
    try {
        server = await ServerProcess.start(settings());
    } catch (error) {
        return tell((error as Error).message);
    }
    let processes = 0;
    const run = async () => {
        if (processes++ > 0) server = await ServerProcess.start(settings());
        return server.process;
    };
    const starting: Client = new Client("msaaLint", "msaa-lint", run, {
        documentSelector: selector(),
        outputChannel: output,
        revealOutputChannelOn: RevealOutputChannelOn.Never,
        initializationFailedHandler: () => false,
        errorHandler: {
            error: () => ({ action: ErrorAction.Continue, handled: true }),
            closed: () => {
                // A server that could not begin would not begin the next time either.
                const restarts = starting.initializeResult !== undefined && processes < MAX_PROCESSES;
                if (!restarts) void server.reason.then(tell);
                return { action: restarts ? CloseAction.Restart : CloseAction.DoNotRestart, handled: true };
            },
        },
    });
    client = starting;
    try {
        await starting.start();
    } catch (error) {
        output.error(String(error));
        if (client === starting) client = undefined;
    }
}

function tell(message: string): void {
    output.error(message);
    void offer(message);
}

async function offer(message: string): Promise<void> {
    const [openSettings, showOutput] = ["Open Settings", "Show Output"];
    const choice = await window.showErrorMessage(message, openSettings, showOutput);
    if (choice === openSettings) await commands.executeCommand("workbench.action.openSettings", "msaaLint.path");
    if (choice === showOutput) output.show();
}
