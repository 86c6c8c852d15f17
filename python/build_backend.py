# SPDX-License-Identifier: MIT
"""What pip asks to build the module: CMake builds and installs it, this packs it (PEP 517)."""
import base64
import hashlib
import os
import re
import subprocess
import sys
import sysconfig
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

OFF = ("TESTS", "EXAMPLES", "BENCHMARKS")


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """``config_settings``: ``build-dir``, a tree of CMake in which the module is built already."""
    settings = config_settings or {}
    with tempfile.TemporaryDirectory() as place:
        build, stage = Path(settings.get("build-dir") or f"{place}/build"), Path(place) / "stage"
        if "build-dir" not in settings:
            _run(
                "cmake",
                "-S",
                ROOT,
                "-B",
                build,
                "-DCMAKE_BUILD_TYPE=Release",
                "-DSIVID_PROGRAMS_WITH_MPI=OFF",
                f"-DPython3_EXECUTABLE={sys.executable}",
                *(f"-DSIVID_BUILD_{name}=OFF" for name in OFF),
            )
            _run("cmake", "--build", build, "--target", "sivid_python", "--parallel", str(os.cpu_count() or 1))
        _run("cmake", "--install", build, "--component", "python", "--prefix", stage)
        module = next(stage.glob("**/sivid/__init__.py"), stage).parent
        if not any(module.glob("_core*")):
            raise FileNotFoundError(
                f"{build}: the module is not built there: cmake --build {build} --target sivid_python"
            )
        files = {f"sivid/{file.name}": file.read_bytes() for file in sorted(module.iterdir()) if file.is_file()}
    return _packed(Path(wheel_directory), files)


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    """Without it pip would compile the module while it says that it prepares metadata."""
    _, about, files = _about()
    (Path(metadata_directory) / about).mkdir()
    for name, content in files.items():
        (Path(metadata_directory) / name).write_bytes(content)
    return about


def _about():
    heading = (ROOT / "include/sivid/version.hpp").read_text()
    version = ".".join(re.findall(r"#define SIVID_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)", heading))
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    tag = f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"
    about = f"sivid-{version}.dist-info"
    metadata = (
        f"Metadata-Version: 2.1\nName: sivid\nVersion: {version}\nLicense: MIT\nRequires-Python: >=3.10\n"
        "Summary: Which parameters of a dynamic model can explain recorded data, with proof\n"
        "Requires-Dist: numpy\nProvides-Extra: plots\nRequires-Dist: matplotlib; extra == 'plots'\n"
    ).encode()
    wheel = f"Wheel-Version: 1.0\nGenerator: sivid\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    return f"sivid-{version}-{tag}.whl", about, {f"{about}/METADATA": metadata, f"{about}/WHEEL": wheel}


def _packed(folder, files):
    name, about, further = _about()
    files.update(further)
    record = [f"{name},sha256={_digest(content)},{len(content)}" for name, content in files.items()]
    files[f"{about}/RECORD"] = "\n".join([*record, f"{about}/RECORD,,", ""]).encode()
    with zipfile.ZipFile(folder / name, "w", zipfile.ZIP_DEFLATED) as wheel:
        for file, content in files.items():
            wheel.writestr(file, content)
    return name


def _digest(content):
    return base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()


def _run(*words):
    subprocess.run([str(word) for word in words], check=True, stdout=sys.stderr)
