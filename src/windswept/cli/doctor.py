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
    report: dict[str, object] = {
        "python": platform.python_version(),
        "system": f"{platform.system()} {platform.machine()}",
        "cores": len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count(),
        "adapter": adapter,
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
    for name, value in report.items():
        if value is not None or name != "mend":
            click.echo(f"{name:<9} {value if value is not None else 'none'}")
    click.echo("packages  " + ", ".join(f"{k} {v}" for k, v in packages.items()))


def find_adapter() -> str | None:
    """One line on the graphics adapter, or None; asked in a child, since a driver's failure can end the process."""
    code = "from windswept.gpu.device import adapter_summary; print(adapter_summary())"
    child = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    return child.stdout.strip() or None


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
