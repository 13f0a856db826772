// Writes what the package takes from the rest of the repository: the JSON Schema of descriptions, and the license.
import { spawnSync } from "node:child_process";
import { copyFileSync, mkdirSync, writeFileSync } from "node:fs";

const command = process.env.MSAA_LINT ?? "msaa-lint";
const result = spawnSync(command, ["schema"], { encoding: "utf8", maxBuffer: 1 << 24 });
if (result.status !== 0) {
    console.error(`\`${command} schema\` failed: ${result.error?.message ?? result.stderr}; set MSAA_LINT to the path of msaa-lint`);
    process.exit(1);
}
mkdirSync("out", { recursive: true });
writeFileSync("out/msaa-lint.schema.json", JSON.stringify(JSON.parse(result.stdout)));
copyFileSync("../../LICENSE", "LICENSE");
