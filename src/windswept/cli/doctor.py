"""``windswept doctor``."""

from __future__ import annotations

import json
import os
import platform
import shutil
import subprocess
import sys
from importlib.metadata import PackageNotFoundError, version

import click

from windswept.errors import GraphicsError
from windswept.gpu.device import DRIVER_LINE

PACKAGES = ("windswept", "numpy", "numba", "wgpu", "rendercanvas", "av", "imgui-bundle", "glfw")


@click.command("doctor")
@click.option(
    "--mend", is_flag=True, help="Install a software Vulkan driver where none is found (Debian, Ubuntu)."
)
@click.option("--json", "as_json", is_flag=True, help="One JSON object instead of lines.")
def command(mend: bool, as_json: bool) -> None:
    """Say what works on this machine, and the one line that mends what does not.

    Example: windswept doctor
    """
    adapter = find_adapter()
    if adapter is None and mend:
        install_driver()
        adapter = find_adapter()
    summary, limits = adapter or (None, None)
    report: dict[str, object] = {
        "python": platform.python_version(),
        "system": f"{platform.system()} {platform.machine()}",
        "cores": len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count(),
        "adapter": summary,
        "limits": limits,
        "display": os.environ.get("WAYLAND_DISPLAY") or os.environ.get("DISPLAY"),
        "packages": {name: installed_version(name) for name in PACKAGES},
        "mend": None if adapter else f"as root: {DRIVER_LINE}",
    }
    if as_json:
        click.echo(json.dumps(report))
    else:
        _print_report(report)
    if adapter is None:
        sys.exit(2)


def _print_report(report: dict[str, object]) -> None:
    packages = report.pop("packages")
    assert isinstance(packages, dict)
    if isinstance(report["limits"], dict):
        report["limits"] = _limits_line(**report["limits"])
    for name, value in report.items():
        if value is not None or name not in ("mend", "limits"):
            click.echo(f"{name:<9} {value if value is not None else 'none'}")
    click.echo("packages  " + ", ".join(f"{k} {v}" for k, v in packages.items()))


def _limits_line(binds_bytes: int, buffer_bytes: int, has_clock: bool) -> str:
    """What fits on the adapter, in words."""
    clock = "a clock for stages" if has_clock else "no clock: no stage is timed"
    return (
        f"shaders see {_in_words(binds_bytes)} of a buffer, which may have {_in_words(buffer_bytes)}; {clock}"
    )


def _in_words(size: int) -> str:
    return f"{size / 2**20:,.0f} MiB" if size < 2**30 else f"{size / 2**30:,.1f} GiB"


def find_adapter() -> tuple[str, dict[str, int | bool]] | None:
    """One line on the graphics adapter and its limits, see `adapter_limits`; None where there is none.

    Asked in a child, since a driver's failure can end the process.
    """
    code = (
        "import json; from windswept.gpu.device import adapter_limits, adapter_summary; "
        "print(json.dumps([adapter_summary(), adapter_limits()]))"
    )
    child = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    if not child.stdout.strip():
        return None
    summary, limits = json.loads(child.stdout)
    return summary, limits


def install_driver() -> None:
    """Installs Debian's software Vulkan driver, if this user may.

    Raises:
        GraphicsError: no apt-get, or not allowed; the message holds the line to run.
    """
    if shutil.which("apt-get") is None:
        raise GraphicsError(
            "no graphics adapter found; install Mesa's Vulkan drivers (lavapipe) for this system"
        )
    root = os.geteuid() == 0
    if not root and subprocess.run(["sudo", "-n", "true"], capture_output=True, check=False).returncode != 0:
        raise GraphicsError(f"no graphics adapter found; mend it with: sudo {DRIVER_LINE}")
    click.echo("no graphics adapter found: installing Debian's software Vulkan driver", err=True)
    sudo = [] if root else ["sudo", "-n"]
    for line in ("apt-get update -q", DRIVER_LINE):
        done = subprocess.run([*sudo, *line.split()], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise GraphicsError(f"{line!r} failed: {done.stderr.strip().splitlines()[-1:]}")


def installed_version(name: str) -> str | None:
    """Version of an installed package, or None."""
    try:
        return version(name)
    except PackageNotFoundError:
        return None
