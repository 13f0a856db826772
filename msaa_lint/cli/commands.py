"""The commands and their options, as a table. `arguments` parses by it; `app` prints help and
completes words from it.
"""

from importlib import import_module

from msaa_lint.core.finding import CONFIDENCES, SEVERITIES
from msaa_lint.core.text.node import Limits

from .options import (
    CHECK_FORMATS,
    CLUSTER,
    COLOR,
    CONFIGURATION,
    COST_FORMATS,
    DIVISION,
    FORCE,
    FRAME_END,
    GLOBAL,
    INPUT_FORMATS,
    INPUTS,
    PAGE_FORMATS,
    PROFILE,
    SCHEMAS,
    SELECTORS,
    Arguments,
    Command,
    Option,
    Paths,
    input_format,
    output,
    text_output,
)

_LIMITS = Limits()

_SIZE = Option("size", "text", "Size in pixels of inputs that state none.", "WxH")

COMMANDS = {
    "check": Command(
        """Find multisampling mistakes in frames.

        Reads descriptions of frames (YAML, JSON), captures (GFXReconstruct, API dump, RenderDoc,
        Fossilize), Vulkan SC pipelines, render
        targets of Flutter's engine, and source code (C, C++, Swift, GLSL, Markdown).
        In a folder, it reads files called *.msaa.yaml (.yml, .json), other data files with content
        that only a frame has, and source code
        that uses multisampling, except what .gitignore ignores. A file that is named is always
        read.

        Exits with 0 if there are no findings, 1 if there are, and 2 if an input, an option, the
        configuration, or msaa-lint failed.

        \b
        Examples:
          msaa-lint check frame.msaa.yaml --profile mali-g76
          msaa-lint check . --fix --output sarif=findings.sarif
        """,
        {
            "Rules": (
                *SELECTORS,
                Option(
                    "edition",
                    "text",
                    "Use the default rules of this edition.",
                    "EDITION",
                    values="editions",
                ),
                PROFILE,
            ),
            "Findings": (
                Option(
                    "min_severity",
                    "choice",
                    "Lowest severity to report.",
                    "SEVERITY",
                    choices=SEVERITIES,
                    default="note",
                ),
                Option(
                    "baseline", "text", "Hide the findings that this baseline file counts.", "FILE"
                ),
                Option("no_ignores", "flag", "Disregard suppression comments."),
                Option(
                    "show_suppressed",
                    "flag",
                    "Report suppressed findings as well, marked as suppressed.",
                ),
            ),
            "Fixes": (
                Option("fix", "flag", "Apply safe fixes in place; for `-`, print the fixed text."),
                Option(
                    "unsafe_fixes",
                    "flag",
                    "With --fix or --diff: include fixes that may change the picture.",
                ),
                Option(
                    "diff",
                    "flag",
                    "Print what --fix would change without writing it; exit "
                    "with 1 if there is a change.",
                ),
            ),
            "Exit code": (
                Option(
                    "fail_on",
                    "choice",
                    "Lowest severity that exits with 1.",
                    "SEVERITY",
                    SEVERITIES,
                    default="warning",
                ),
                Option(
                    "fail_confidence",
                    "choice",
                    "Lowest confidence that exits with 1.",
                    "LEVEL",
                    CONFIDENCES,
                    default="medium",
                ),
                Option(
                    "fail_on_cost",
                    "text",
                    "Exit with 1 if fixes would save this much of an input: 50MB/s, 100mW, 16MiB.",
                    "COST",
                ),
                Option(
                    "strict_inputs",
                    "flag",
                    "Exit with 2 if an input creates multisampled "
                    "images but shows no pass to check.",
                ),
                Option("exit_zero", "flag", "Exit with 0 even if there are findings."),
            ),
            "Output": (
                output(*CHECK_FORMATS, default="full; concise in a pipe"),
                Option(
                    "sort",
                    "choice",
                    "Order of the findings.",
                    "ORDER",
                    choices=("place", "price"),
                    default="place",
                ),
                Option("statistics", "flag", "Print counts and costs by rule instead of findings."),
                Option(
                    "watch",
                    "flag",
                    "Check again whenever an input, the configuration, or a "
                    "rule page changes (extra `watch`).",
                ),
                Option(
                    "explain_undecided",
                    "flag",
                    "List what to add to the input for each rule that it does not decide.",
                ),
                COLOR,
            ),
            "Inputs": (
                *INPUTS,
                *DIVISION,
                Option(
                    "max_depth",
                    "integer",
                    "Maximum nesting depth of an input.",
                    "N",
                    default=str(_LIMITS.depth),
                ),
                Option(
                    "max_nodes",
                    "integer",
                    "Maximum number of nodes in an input, aliases expanded.",
                    "N",
                    default=str(_LIMITS.nodes),
                ),
                Option(
                    "max_bytes",
                    "integer",
                    "Maximum size of an input in bytes.",
                    "N",
                    default=str(_LIMITS.bytes),
                ),
            ),
            "Configuration": CONFIGURATION,
            "Other": GLOBAL,
        },
    ),
    "cost": Command(
        """Show what a frame costs in bandwidth, memory, and power.

        Prints MB/s, MiB, and mW by pass and attachment, or for two files, what the second adds.

        Exits with 0, or with 2 if an input, an option, or the configuration failed; the other
        inputs are still shown.
        """,
        {
            "Frame": (
                Option("fps", "decimal", "Frames per second, overriding the input.", "FPS"),
                _SIZE,
                PROFILE._replace(
                    help="Device to assume for captures and inputs that name none.",
                    metavar="NAME|PATH",
                ),
                Option(
                    "milliwatts_per_gbps",
                    "decimal",
                    "Power per GB/s of traffic.",
                    "MW",
                    default="the device's, else 100",
                ),
            ),
            "Comparison": (
                Option(
                    "budget",
                    "text",
                    "Power budget to compare with, as in 2500mW.",
                    "POWER",
                    default="2.5W for a tile-based GPU",
                ),
                Option(
                    "samples",
                    "text",
                    "Other sample counts to estimate.",
                    "N,...",
                    default="1,2,4,8",
                    values="cost_samples",
                ),
                Option(
                    "each", "flag", "Show two inputs one after the other instead of comparing them."
                ),
            ),
            "Output": (
                output(*COST_FORMATS),
                Option(
                    "chart",
                    "text",
                    "Draw a chart to an .svg, .png, or .json (Vega-Lite) file (extra `chart`).",
                    "FILE",
                ),
                COLOR,
            ),
            "Inputs": (*INPUTS, *DIVISION),
            "Configuration": CONFIGURATION,
            "Other": GLOBAL,
        },
        Paths(
            "PATH...",
            "Files and folders; - is standard input. Exactly two files are compared: "
            "what the second adds.",
        ),
    ),
    "confirm": Command(
        """Render inputs on a Vulkan device to confirm their findings.

        Reports whether passes are created, whether the validation layer agrees, and whether safe
        fixes keep the picture.

        Exits with 0 if everything is confirmed, 1 if something disagrees or a driver died, and 2 if
        an input or the environment failed.
        """,
        {
            "Device": (
                Option(
                    "device",
                    "text",
                    "Device, by part of its name.",
                    "NAME",
                    repeatable=True,
                    default="llvmpipe, else the first",
                ),
                Option(
                    "list_devices",
                    "flag",
                    "List the devices that the Vulkan loader finds, and exit.",
                ),
                Option(
                    "no_gate",
                    "flag",
                    "Also try what the device does not support; a driver may "
                    "crash, in its own process.",
                ),
                Option("no_layer", "flag", "Do not load the validation layer."),
                Option("timeout", "text", "Time limit for one pass.", "SECONDS", default="30"),
            ),
            "Frame": (
                Option("size", "text", "Size in pixels, overriding the input.", "WxH"),
                Option(
                    "samples",
                    "integer",
                    "Sample count of all multisampled images, overriding the input.",
                    "N",
                    values="cost_samples",
                ),
                Option(
                    "resolves",
                    "flag",
                    "Compare color resolves with their samples, too; depth and stencil always are.",
                ),
            ),
            "Times": (
                Option(
                    "time", "flag", "Measure times.  [default: on a GPU, not on a software driver]"
                ),
                Option("no_time", "flag", "Do not measure times."),
                Option(
                    "repeats",
                    "integer",
                    "Number of timed runs of each version of a pass.",
                    "N",
                    default="15",
                ),
            ),
            "Rules": (*SELECTORS, PROFILE),
            "Output": (
                output(*PAGE_FORMATS),
                Option(
                    "image",
                    "text",
                    "Write pictures to this folder: as written, fixed, "
                    "difference, enlarged edge (PNG).",
                    "DIR",
                ),
                FORCE,
                COLOR,
            ),
            "Inputs": (
                *INPUTS,
                DIVISION[0]._replace(
                    help="Inputs to try at once, unless times are measured.",
                    default="1; the workers of a cluster",
                ),
                *CLUSTER,
            ),
            "Configuration": CONFIGURATION,
            "Other": (
                GLOBAL[0],
                GLOBAL[1]._replace(
                    help="Also show what only msaa-lint reports, noise and output of the layer and "
                    "the driver, and inputs and settings."
                ),
                *GLOBAL[2:],
            ),
        },
        standalone=("list_devices",),
    ),
    "study": Command(
        """Measure the error and cost of sampling techniques.

        Compares 1 to 16 samples, sample shading, and supersampling with the exact picture, for
        scenes by name (--list-scenes), meshes
        (.obj, .ply), and descriptions. Exits with 0, or with 2 if something failed.
        """,
        {
            "Study": (
                Option("list_scenes", "flag", "List the scenes, and exit."),
                Option(
                    "samples",
                    "text",
                    "Sample counts.",
                    "N,...",
                    default="1,2,4,8,16",
                    values="study_samples",
                ),
                Option(
                    "techniques",
                    "text",
                    "Techniques to compare.",
                    "NAME,...",
                    default="msaa,sample-shading,ssaa",
                    values="techniques",
                ),
                Option(
                    "size",
                    "text",
                    "Size in pixels.",
                    "WxH",
                    default="the description's, else 1920x1080",
                ),
                Option(
                    "bits",
                    "choice",
                    "Sub-pixel precision of vertices, in bits.",
                    "BITS",
                    choices=("4", "8"),
                    default="8",
                ),
                Option(
                    "flip",
                    "flag",
                    "Also measure FLIP, the difference that a viewer notices (extra `flip`).",
                ),
                Option("ssim", "flag", "Also measure structural similarity (extra `ssim`)."),
                PROFILE._replace(
                    help="Device whose traffic to estimate for captures and inputs that name none."
                ),
            ),
            "Times": (
                Option(
                    "device",
                    "text",
                    "Measure times on this Vulkan device, by part of its name.",
                    "NAME",
                    default="no times",
                ),
                Option(
                    "shading",
                    "text",
                    "Costs of shading: none, light, medium, heavy, 200ops, 500000ns (a million "
                    "invocations), 4ms (a full screen).",
                    "COST,...",
                    default="none,medium,heavy",
                ),
                Option(
                    "shader",
                    "text",
                    "Fragment shader to time techniques with: .spv or GLSL.",
                    "FILE",
                ),
                Option(
                    "overdraw", "integer", "Draw each triangle this many times.", "N", default="1"
                ),
                Option(
                    "triangle_size",
                    "decimal",
                    "Split triangles until no side is longer than this.",
                    "PIXELS",
                    default="as they are",
                ),
                Option(
                    "repeats",
                    "integer",
                    "Number of rounds in which techniques are timed.",
                    "N",
                    default="15, fewer of slow frames",
                ),
                Option(
                    "budget",
                    "text",
                    "Recommend what adds at most this time to one sample: 0.5ms, 500us.",
                    "TIME",
                    default="1ms",
                ),
            ),
            "Output": (
                output(*PAGE_FORMATS),
                Option(
                    "plot",
                    "text",
                    "Draw error against time to an .svg, .png, or .json "
                    "(Vega-Lite) file (extra `chart`).",
                    "FILE",
                ),
                Option(
                    "crops",
                    "text",
                    "Write enlarged crops of each scene to this folder (PNG; extra `chart`).",
                    "DIR",
                ),
                Option(
                    "record",
                    "flag",
                    "Write a record next to each description, for rule sample-count-above-four.",
                ),
                FORCE,
                COLOR,
            ),
            "Execution": (
                Option(
                    "resume",
                    "text",
                    "Save finished points in this folder, and reuse those already there.",
                    "FOLDER",
                ),
                Option(
                    "jobs",
                    "integer",
                    "Points to simulate at once.",
                    "N",
                    default="one per core, or per cluster worker",
                ),
                *CLUSTER,
            ),
            "Inputs": INPUTS,
            "Configuration": CONFIGURATION,
            "Other": GLOBAL,
        },
        Paths("INPUT...", "Scenes, meshes, descriptions; - is standard input.", values="scenes"),
        ("list_scenes",),
    ),
    "corpus": Command(
        """Summarize the findings of many inputs.

        Reads what `msaa-lint check` wrote with --output parquet=FILE or sqlite=FILE, of one run or
        of several together: where the most
        can be saved, how prices are distributed, and what has changed (extra `corpus`). --sql
        answers a question of your own.

        Exits with 0, or with 2 if a file, an option, or the query failed.

        \b
        Examples:
          msaa-lint check captures --output parquet=findings.parquet
          msaa-lint corpus findings.parquet --by engine --since last-week.parquet
          msaa-lint corpus findings.parquet --sql 'select * from passes'
        """,
        {
            "Summary": (
                Option(
                    "by",
                    "choice",
                    "What to group findings by.",
                    "WHAT",
                    ("rule", "engine", "device", "input"),
                    default="rule",
                ),
                Option(
                    "since",
                    "text",
                    "Show what is new and gone since this earlier file or folder.",
                    "PATH",
                ),
                Option("top", "integer", "Rows of a table.", "N", default="20; in JSON all"),
                Option(
                    "sql",
                    "text",
                    "Print the rows of a SELECT over findings, passes, inputs, and run instead.",
                    "QUERY",
                ),
            ),
            "Output": (output(*COST_FORMATS), COLOR),
            "Other": GLOBAL,
        },
        Paths("PATH...", "Parquet files of findings, SQLite files, and folders of them."),
    ),
    "rule": Command(
        """Explain a rule, or list all rules.

        Custom rules of the configuration are included. A custom rule is a page like those that this
        command prints; `msaa-lint facts`
        lists what its condition can use.
        """,
        {
            "Options": (
                Option("all", "flag", "List all rules."),
                text_output("text", "markdown", "json"),
                SELECTORS[3],
                *CONFIGURATION,
                *GLOBAL,
            ),
        },
        Paths(
            "NAME",
            "A rule's name or code, in any case; none: list all rules.",
            0,
            1,
            values="rules",
        ),
    ),
    "device": Command(
        """Show what a device supports for multisampling.""",
        {
            "Options": (
                text_output("text", "json", "description"),
                Option("list", "flag", "List the built-in devices."),
                *GLOBAL,
            ),
        },
        Paths(
            "NAME|PATH...",
            "Built-in devices and reports; - is standard input; none: the installed drivers.",
            0,
            values="devices",
        ),
    ),
    "facts": Command(
        """List facts that rules can use, or their values in an input.""",
        {
            "Options": (
                text_output("text", "json", "markdown"),
                PROFILE._replace(help="Device to assume for an input that names none."),
                FRAME_END,
                *GLOBAL,
            ),
        },
        Paths(
            "PATH...",
            "An input, or folders and files of source code; none: all facts that a rule can use.",
            0,
        ),
    ),
    "convert": Command(
        """Convert a capture or source code to a description.

        The description can be read, edited, fixed, and confirmed. Render targets are converted to
        plain descriptions, too.

        Several inputs are converted to several descriptions, in a folder: that of
        `captures/a/b.jsonl` is `a/b.jsonl.msaa.yaml` for the
        input `captures`. Source files of a program are converted together.

        Exits with 0, or with 2 if an input has mistakes or a capture is truncated; the part that
        can be read, and the other inputs, are
        still written.
        """,
        {
            "Options": (
                Option(
                    "output",
                    "text",
                    "Write to this file, or to a folder: an existing one, or `NAME/`.",
                    "PATH",
                    short="-o",
                ),
                Option("force", "flag", "Overwrite existing files."),
                input_format(*INPUT_FORMATS[2:]),
                FRAME_END,
                *DIVISION,
                *GLOBAL,
            ),
        },
        Paths(
            "INPUT...",
            "Captures, render targets, or source code; folders of these; - is standard input.",
        ),
    ),
    "schema": Command(
        """Print a JSON Schema.""",
        {"Options": GLOBAL},
        Paths(
            "WHICH",
            "The description format (the default), or the JSON of a command: json-v1 is "
            "that of `check`.",
            0,
            1,
            SCHEMAS,
        ),
    ),
    "lsp": Command(
        """Run the language server, for editors.""",
        {
            "Options": (
                Option(
                    "stdio",
                    "flag",
                    "Communicate over standard input and output: the default, and the only way.",
                ),
                *GLOBAL,
            ),
        },
        Paths("", "", 0, 0),
    ),
    "baseline": Command(
        """Record the current findings, so that only new ones are reported.""",
        {
            "Options": (
                Option(
                    "file", "text", "The baseline file.", "FILE", default="msaa-lint-baseline.json"
                ),
                Option("prune", "flag", "Only remove fixed findings."),
                *CONFIGURATION,
                *GLOBAL,
            ),
        },
        Paths("PATH...", "Files and folders to lint."),
    ),
    "init": Command(
        """Write a configuration, a first description, and its schema.""",
        {"Options": GLOBAL},
        Paths("FOLDER", "Folder to write to; none: the current one.", 0, 1),
    ),
}


def run(name: str, arguments: Arguments) -> int:
    """Runs a command of `COMMANDS` and returns its exit code."""
    code: int = getattr(import_module(f".{name}", __package__), name)(arguments)
    return code
