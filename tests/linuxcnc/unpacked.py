"""LinuxCNC, unpacked from its Debian packages and not installed: a control that this project did not write.

`unpacked()` gives the folder, with `usr/bin/rs274`, `usr/bin/linuxcnc`, `usr/lib/linuxcnc/modules` and the rest in it. The
first call downloads (22 MB) and unpacks (85 MB) the packages into a folder for caches outside of the repository; later calls
take what is there, and workers of one test run wait for each other. It raises `NotHereError` where there is no Debian.

To run a program of it, take `environment()`: its libraries are found through LD_LIBRARY_PATH, and HOME is a scratch folder,
because the interpreter writes a file there::

    from tests.linuxcnc.unpacked import environment, unpacked

    root = unpacked()
    subprocess.run([root / "usr/bin/rs274", "-g", "program.ngc"], env=environment(root, tmp_path))

A full headless run (`linuxcnc -r test.ini`) has the paths of an installation in it, so the unpacked folders are laid over
`/usr` and `/etc` in a mount namespace of its own, and root is given up, because rtapi refuses it. `may_run_headless()` says
whether this machine lets a test do so::

    unshare -m -p -f --mount-proc bash run.sh
    # run.sh: mount -t overlay overlay -o lowerdir=ROOT/usr:/usr /usr
    #         mount -t overlay overlay -o lowerdir=ROOT/etc:/etc /etc
    #         setpriv --reuid=65534 --regid=65534 --clear-groups env HOME=SCRATCH linuxcnc -r test.ini

A test asks with `linuxcnc_or_skip()`: on Debian as root LinuxCNC can be had, so that its absence is a failure; elsewhere
the test is left out, and the last line of the test run says so.
"""

from __future__ import annotations

import os
import platform
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path

import pytest

PACKAGE = "linuxcnc-uspace"
WITH = "libboost-python"
"""Beginning of the name of the one package beside it that a small Debian lacks."""


class NotHereError(Exception):
    """Why LinuxCNC cannot be had."""


def linuxcnc_or_skip() -> Path:
    """The unpacked folder; leaves the test out where there is no Debian, fails it on Debian as root."""
    try:
        return unpacked()
    except NotHereError as why:
        if is_debian() and os.geteuid() == 0:
            pytest.fail(f"LinuxCNC must be there on Debian as root: {why}")
        pytest.skip(f"LinuxCNC: {why}")


def is_debian() -> bool:
    """Whether packages of Debian (or of a sister) can be had here."""
    return sys.platform == "linux" and all(map(shutil.which, ("apt-get", "apt-cache", "dpkg")))


@cache
def unpacked() -> Path:
    """The folder in which LinuxCNC is unpacked.

    Raises
    ------
    NotHereError
        If it is not there and cannot be had.
    """
    if not is_debian():
        raise NotHereError("its packages are for Debian")
    folder = cache_folder() / f"{PACKAGE}-{platform.machine()}"
    if not _complete(folder):
        folder.parent.mkdir(parents=True, exist_ok=True)
        with alone(folder.with_suffix(".lock")):
            if not _complete(folder):
                _unpack(folder)
    return folder


def cache_folder() -> Path:
    """Where test runs keep what they have downloaded: ELASTOGEO_TEST_CACHE, else below the folder for caches."""
    given = os.environ.get("ELASTOGEO_TEST_CACHE")
    return Path(given) if given else Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "elastogeo-tests"


def environment(root: Path, home: Path) -> dict[str, str]:
    """The environment in which programs of the unpacked folder find their libraries."""
    libraries = [root / "usr/lib", *(root / "usr/lib").glob("*-linux-gnu")]
    return {**os.environ, "LD_LIBRARY_PATH": os.pathsep.join(map(str, libraries)), "HOME": str(home)}


@cache
def may_run_headless() -> bool:
    """Whether a mount namespace may be made, and a folder laid over another in it."""
    if not is_debian() or os.geteuid() != 0 or not all(map(shutil.which, ("unshare", "setpriv", "mount"))):
        return False
    with tempfile.TemporaryDirectory() as folder:
        probe = f"mount -t overlay overlay -o lowerdir={folder}:/usr /usr"
        return subprocess.run(["unshare", "-m", "sh", "-c", probe], capture_output=True, check=False).returncode == 0


def _complete(folder: Path) -> bool:
    return (folder / "usr/bin/rs274").is_file()


@contextmanager
def alone(lock: Path) -> Iterator[None]:
    """One process at a time."""
    import fcntl

    with open(lock, "w") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        yield


def _unpack(folder: Path) -> None:
    """Download the packages and unpack them beside their place; the last step puts the folder there whole."""
    with tempfile.TemporaryDirectory(dir=folder.parent) as scratch:
        if os.geteuid() == 0 and not _dependency():
            _run(["apt-get", "update", "-q"], scratch)
        beside = _dependency()
        if not beside:
            raise NotHereError(f"this Debian knows no package {PACKAGE}; as root: apt-get update")
        _run(["apt-get", "download", "-q", PACKAGE, beside], scratch)
        root = Path(scratch) / "root"
        for package in sorted(Path(scratch).glob("*.deb")):
            _run(["dpkg", "-x", str(package), str(root)], scratch)
        if not _complete(root):
            raise NotHereError(f"the package {PACKAGE} has no interpreter in it")
        root.chmod(0o755)
        root.rename(folder)


def _dependency() -> str:
    """The name of the package that the interpreter needs beside its own; empty if the lists of packages are not there."""
    shown = subprocess.run(["apt-cache", "depends", PACKAGE], capture_output=True, text=True, check=False).stdout
    found = re.search(rf"Depends: ({WITH}[\w.+-]*)", shown)
    return found[1] if found else ""


def _run(command: list[str], folder: str) -> None:
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode:
        last = (done.stderr.strip().splitlines() or ["no message"])[-1]
        raise NotHereError(f"{' '.join(command[:2])} failed: {last[:200]}")
