// The command that is the language server, and its process.
import { type ChildProcess, spawn } from "node:child_process";
import { homedir } from "node:os";
import { workspace } from "vscode";

export interface Settings {
    enable: boolean;
    path: string;
    args: string[];
}

export function settings(): Settings {
    const configuration = workspace.getConfiguration("msaaLint");
    return {
        enable: configuration.get("enable", true),
        path: expanded(configuration.get("path", "msaa-lint")),
        args: configuration.get<string[]>("arguments", []),
    };
}

function expanded(path: string): string {
    const folder = workspace.workspaceFolders?.[0]?.uri.fsPath ?? "";
    return (path || "msaa-lint").replace(/^~(?=[/\\])/, () => homedir()).replaceAll("${workspaceFolder}", () => folder);
}

/** A running server, and what it last wrote to standard error. */
export class ServerProcess {
    private errors = "";
    /** Why the server ended, as it said itself; once it has. */
    readonly reason: Promise<string>;

    private constructor(readonly process: ChildProcess) {
        this.reason = new Promise((resolve) => process.once("close", () => resolve(this.lastLine())));
        process.stderr?.on("data", (data: Buffer) => {
            this.errors = (this.errors + data.toString()).slice(-4096);
        });
    }

    /** Starts `msaa-lint lsp`; rejects with a message for the user if the command cannot be run. */
    static start({ path, args }: Settings): Promise<ServerProcess> {
        const folder = workspace.workspaceFolders?.[0]?.uri.fsPath;
        return new Promise((resolve, reject) => {
            const child = spawn(path, ["lsp", ...args], { cwd: folder ?? homedir(), shell: false });
            const server = new ServerProcess(child);
            child.once("spawn", () => resolve(server));
            child.once("error", (error: NodeJS.ErrnoException) => {
                const reason = error.code === "ENOENT" ? "was not found" : `cannot be run: ${error.message}`;
                reject(new Error(`The command \`${path}\` ${reason}. Install msaa-lint with its extra \`lsp\`, or set \`msaaLint.path\`.`));
            });
        });
    }

    private lastLine(): string {
        const line = this.errors.trim().split("\n").at(-1);
        return line ? `msaa-lint: ${line.replace(/^(?:msaa-lint: )?(?:error: )?/, "")}` : "The language server of msaa-lint ended.";
    }
}
