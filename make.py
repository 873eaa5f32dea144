"""Set up elastogeo and run its everyday tasks, with nothing but Python: `python -m make demo`.

The Makefile calls this script, so Windows and Linux run the same steps. It needs the standard library only, makes the
virtual environment `.venv` beside it, installs what the task needs, pinned by `constraints.txt`, and says how long
each step took. An install is repeated only when `pyproject.toml` or `constraints.txt` has changed, or when a task needs
more.
"""

import hashlib
import importlib.util
import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

OLDEST = (3, 11)
ROOT = Path(__file__).resolve().parent
VENV = ROOT / ".venv"
VENV_PYTHON = VENV / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
STAMP = VENV / "elastogeo-install.json"

PYTEST = ["-m", "pytest", "-n", "auto", "--dist", "worksteal"]
DEVELOPER = ["all", "dev", "docs"]
CHECKS = [
    ("lint", ["-m", "ruff", "check", "."]),
    ("format", ["-m", "ruff", "format", "--check", "."]),
    ("types", ["-m", "mypy"]),
    ("layers", ["lint-imports"]),
]
# task: what it does, the extras it needs, the steps (label, arguments of the environment's Python or a tool in it)
TASKS = {
    "demo": (
        "identify the example test, print the result, write the report",
        ["report", "history"],
        [("demo", ["-m", "elastogeo", "demo"])],
    ),
    "web": ("serve the pages, with a fleet to look at", ["web"], [("web", ["-m", "elastogeo", "serve", "--demo"])]),
    "test": ("run every test", DEVELOPER, [("test", PYTEST)]),
    "bench": (
        "time whole commands, the solver, campaigns, plans, programs, maps, paths, a history, pages (minutes)",
        DEVELOPER,
        [
            ("commands", ["benchmarks/commands.py"]),
            ("solver", ["benchmarks/run.py"]),
            ("monte carlo", ["benchmarks/monte_carlo.py"]),
            ("campaigns", ["benchmarks/campaigns.py"]),
            ("plans", ["benchmarks/plans.py"]),
            ("programs", ["benchmarks/programs.py"]),
            ("maps", ["benchmarks/maps.py"]),
            ("paths", ["benchmarks/paths.py"]),
            ("changes", ["benchmarks/changes.py"]),
            ("history", ["benchmarks/history.py"]),
            ("web", ["benchmarks/web.py"]),
        ],
    ),
    "studies": (
        "count how often each check of a verdict is right, and write docs/verdicts.md (half an hour)",
        DEVELOPER,
        [("studies", ["-m", "studies.run"]), ("coverage", ["-m", "studies.coverage"])],
    ),
    "nightly": (
        "the tests that take too long for every day, then the studies and a large history",
        DEVELOPER,
        [
            ("long tests", [*PYTEST, "-m", "nightly"]),
            ("studies", ["-m", "studies.run"]),
            ("large history", ["benchmarks/history.py", "1000", "500"]),
        ],
    ),
    "check": ("lint, format, types (mypy --strict) and import layers", DEVELOPER, CHECKS),
    "docs": (
        "build the documentation into docs/_build/html",
        DEVELOPER,
        [("docs", ["-m", "sphinx", "-q", "-E", "-W", "--keep-going", "docs", "docs/_build/html"])],
    ),
}
OTHER_TASKS = {
    "clean": "remove caches and built files; keep .venv and your results",
    "help": "show this list",
}
CLEANED = [
    ".benchmarks", ".hypothesis", ".import_linter_cache", ".mypy_cache", ".pytest_cache", ".ruff_cache",
    "build", "dist", "docs/_build",
]  # fmt: skip


class StepError(Exception):
    """A step did not succeed: `sentence` for the person at the keyboard, `code` for the shell."""

    def __init__(self, sentence, code=1):
        super().__init__(sentence)
        self.code = code


class Clock:
    """The steps so far, each with its outcome and the seconds it took."""

    def __init__(self):
        self.rows = []

    def step(self, label, what, action, *arguments):
        """Announce a step, do it, keep its time whether it succeeds or not."""
        print(f"==> {label}: {what}", flush=True)
        start = time.perf_counter()
        outcome = "failed"
        try:
            outcome = action(*arguments) or "done"
        finally:
            self.rows.append((label, outcome, time.perf_counter() - start))

    def table(self):
        """Print every step and the total, in seconds."""
        rows = [*self.rows, ("total", "", sum(seconds for _, _, seconds in self.rows))]
        width = max(len(label) for label, _, _ in rows)
        print(f"\n{'step':<{width}}  {'outcome':<15}  {'seconds':>8}")
        for label, outcome, seconds in rows:
            print(f"{label:<{width}}  {outcome:<15}  {seconds:8.1f}")
        sys.stdout.flush()


def main(arguments):
    """Run the task named on the command line; return the exit code."""
    known = [*TASKS, *OTHER_TASKS]
    if len(arguments) > 1 or (arguments and arguments[0] not in known):
        print(f"make.py: got {' '.join(arguments)!r}; expected one of {', '.join(known)}.", file=sys.stderr)
        return 2
    task = arguments[0] if arguments else "help"
    if task == "help":
        return show_help()
    if task == "clean":
        return clean()
    clock = Clock()
    code = 0
    try:
        run_task(task, clock)
    except StepError as failure:
        print(f"\nmake.py: {failure}", file=sys.stderr, flush=True)
        code = failure.code
    clock.table()
    return code


def run_task(task, clock):
    """Make the environment, install what the task needs, then run its steps in order."""
    _, extras, steps = TASKS[task]
    clock.step("environment", f"Python {sys.version.split()[0]} in {VENV.name}", make_environment)
    requirement = f".[{','.join(extras)}]"
    clock.step("install", f"elastogeo {requirement} (minutes the first time)", install, requirement, extras)
    for label, command in steps:
        clock.step(label, shown(command), run, command)


def make_environment():
    """Create `.venv`, or again if its Python no longer runs."""
    if VENV_PYTHON.exists() and runs(VENV_PYTHON):
        return "kept"
    if importlib.util.find_spec("ensurepip") is None or importlib.util.find_spec("venv") is None:
        version = "{}.{}".format(*sys.version_info[:2])
        raise StepError(
            f"this Python ({sys.executable}) cannot make a virtual environment: its modules venv and ensurepip are not "
            f"installed.\nOn Debian or Ubuntu: apt-get install python{version}-venv (or python3-venv). "
            "Elsewhere: install a complete Python, with pip. Then run the same command again."
        )
    command = [sys.executable, "-m", "venv", "--clear", str(VENV)]
    code = subprocess.run(command, cwd=ROOT, check=False).returncode
    if code:
        raise StepError(f"could not create {VENV}. The command was:\n  {' '.join(command)}", code)
    return "created"


def install(requirement, extras):
    """Install elastogeo in place with these extras, unless the stamp says that it is there already."""
    fingerprint = installation_fingerprint()
    installed = installed_extras(fingerprint)
    if all(extra in installed for extra in extras):
        return "already there"
    STAMP.unlink(missing_ok=True)
    arguments = ["-m", "pip", "install", "--no-input", "--disable-pip-version-check"]
    arguments += ["-c", "constraints.txt", "-e", requirement]
    pip = subprocess.run(
        in_environment(arguments),
        cwd=ROOT,
        check=False,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        encoding="utf-8",
        errors="replace",
    )
    if pip.returncode:
        print(pip.stdout, flush=True)
        raise StepError(
            "pip could not install elastogeo and what it stands on; pip's own words are above. The command was:\n"
            f"  {shown(arguments)}",
            pip.returncode,
        )
    extras = sorted({*installed, *extras})
    STAMP.write_text(json.dumps({"fingerprint": fingerprint, "extras": extras}) + "\n", encoding="utf-8")
    return "installed"


def installation_fingerprint():
    """Hash what an editable install depends on: the two files, this folder and the environment's Python."""
    digest = hashlib.sha256(repr((str(ROOT), str(VENV_PYTHON.resolve()))).encode())
    for name in ("pyproject.toml", "constraints.txt"):
        digest.update((ROOT / name).read_bytes())
    return digest.hexdigest()


def installed_extras(fingerprint):
    """Extras that are installed, `all` counted with what it contains; none when the fingerprint differs."""
    try:
        stamp = json.loads(STAMP.read_text(encoding="utf-8"))
        extras = set(stamp["extras"]) if stamp["fingerprint"] == fingerprint else set()
    except (OSError, ValueError, KeyError, TypeError):
        return set()
    return extras | {"report", "logs", "live", "history", "postgresql", "web"} if "all" in extras else extras


def run(command):
    """Run a command of the environment, its output straight to the screen."""
    environment = dict(os.environ)
    if (
        command[: len(PYTEST)] == PYTEST
    ):  # one process a core already: more threads in each would only get in each other's way
        for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
            environment.setdefault(name, "1")
    code = subprocess.run(in_environment(command), cwd=ROOT, env=environment, check=False).returncode
    if code:
        raise StepError(f"this command failed with exit code {code}:\n  {shown(command)}", code if code > 0 else 1)


def runs(python):
    """Whether this Python starts and is new enough."""
    test = f"import sys; sys.exit(sys.version_info[:2] < {OLDEST!r})"
    try:
        return subprocess.call([str(python), "-c", test], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) == 0
    except OSError:
        return False


def in_environment(command):
    """Complete a command with the path of the environment's Python, or of the tool that it names."""
    if command[0].startswith("-") or command[0].endswith(".py"):
        return [str(VENV_PYTHON), *command]
    return [str(VENV_PYTHON.with_name(command[0])), *command[1:]]


def shown(command):
    """The command as a person would type it, from this folder."""
    program, *words = in_environment(command)
    words = [f'"{word}"' if " " in word or "[" in word else word for word in words]
    return " ".join([str(Path(program).relative_to(ROOT)), *words])


def show_help():
    """Print every task with its meaning."""
    described = {**{name: task[0] for name, task in TASKS.items()}, **OTHER_TASKS}
    print("make TASK, or without make: python -m make TASK\n")
    for name, meaning in described.items():
        print(f"  {name:<9}{meaning}")
    return 0


def clean():
    """Remove caches and built files, nothing that a person made."""
    folders = [ROOT / name for name in CLEANED]
    for top in ("src", "tests", "studies", "benchmarks", "docs", "examples", "__pycache__"):
        folders += sorted((ROOT / top).rglob("__pycache__")) if top != "__pycache__" else [ROOT / top]
    for folder in folders:
        if folder.is_dir():
            shutil.rmtree(folder)
            print(f"removed {folder.relative_to(ROOT)}")
    return 0


def newer_python():
    """Find a Python on the path that is new enough, or None."""
    for minor in range(19, OLDEST[1] - 1, -1):
        found = shutil.which(f"python3.{minor}")
        if found and runs(found):
            return found
    return None


def start():
    """Check Python's version, hand over to a newer one where there is one, then run the task."""
    if sys.version_info[:2] < OLDEST:
        newer = newer_python()
        if newer:
            return subprocess.run([newer, __file__, *sys.argv[1:]], check=False).returncode
        wanted = "{}.{}".format(*OLDEST)
        print(
            f"make.py: elastogeo needs Python {wanted} or newer; this is {sys.version.split()[0]} ({sys.executable}).\n"
            f"Install one and call it by name: make PYTHON=python{wanted} TASK, or python{wanted} -m make TASK.",
            file=sys.stderr,
        )
        return 2
    return main(sys.argv[1:])


if __name__ == "__main__":
    try:
        sys.exit(start())
    except KeyboardInterrupt:
        print("\nmake.py: stopped at the keyboard.", file=sys.stderr)
        sys.exit(130)
