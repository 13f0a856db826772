"""How to install an extra of this package, wherever the package came from. The imports are late:
`check` seldom needs them.
"""

import os

from .package import FOLDER


def needs_extra(feature: str, extra: str) -> str:
    """The message that a feature needs an extra, with the command that installs it."""
    return f"{feature} needs the extra `{extra}`: run `{pip_install(_requirement(extra))}`"


def pip_install(requirement: str) -> str:
    """The shell command that installs a package in the environment of this process."""
    import shutil
    import sys
    from importlib.util import find_spec

    pip = shutil.which("pip")
    if find_spec("pip") is None:
        install = f"uv pip install --python {_quote(sys.executable)}"
    elif pip and os.path.dirname(os.path.abspath(pip)) == os.path.dirname(sys.executable):
        install = "pip install"
    else:
        install = f"{_quote(sys.executable)} -m pip install"
    return f"{install} {requirement}"


def _requirement(extra: str) -> str:
    """The extra, of the checkout that runs or from where the package was installed."""
    # A wheel has the rule pages inside the package, a checkout beside it.
    if not os.path.isdir(os.path.join(FOLDER, "rules")):
        return "--editable " + _quote(f"{os.path.dirname(FOLDER)}[{extra}]")
    url = _installed_url()
    return _quote(f"msaa-lint[{extra}]" + (f" @ {url}" if url else ""))


def _installed_url() -> str | None:
    """The URL of the folder, file, or repository that was installed (PEP 610); None for a release
    from a package index.
    """
    import json
    from importlib import metadata

    try:
        origin = json.loads(metadata.distribution("msaa-lint").read_text("direct_url.json") or "{}")
    except metadata.PackageNotFoundError:
        return None
    if revision := origin.get("vcs_info"):
        return f"{revision['vcs']}+{origin['url']}@{revision['commit_id']}"
    url: str | None = origin.get("url")
    return url


def _quote(text: str) -> str:
    """One word of a shell command. Of cmd.exe's quotes, only double ones work."""
    import shlex

    return shlex.quote(text) if os.name == "posix" else f'"{text}"'
