"""Packages that agglo can do without."""

from __future__ import annotations

from importlib import import_module
from types import ModuleType

from agglo._errors import PackageError

# Which extra of the package brings which module; the others are asked for by name.
_EXTRAS = {
    "matplotlib": "plots",
    "networkx": "plots",
    "pandas": "plots",
    "pyarrow": "plots",
    "pyvista": "plots",
    "scipy": "cluster",
    "sklearn": "cluster",
}


def need(module: str, purpose: str) -> ModuleType:
    """The module, which must be installed for the purpose, such as "Run.plot".

    Raises:
        PackageError: It is not installed; the message says what to install.
    """
    try:
        return import_module(module)
    except ImportError as error:
        package = module.partition(".")[0]
        # A package that is there and does not load says itself what it lacks.
        why = "is not installed" if error.name == package else f"cannot be loaded ({error})"
        wanted = f'"agglo[{_EXTRAS[package]}]"' if package in _EXTRAS else package
        raise PackageError(f"{purpose} needs {package}, which {why}; pip install {wanted}", name=package) from error
