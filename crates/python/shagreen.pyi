"""Shagreen: haptic textures, authored, rendered, evaluated and exported.

Quantities are in SI units, which the names of arguments and results state. Positions in a space are from 0 to 100.
"""

import os
from typing import Any, Iterator, Literal, Mapping, Sequence, TypedDict, Union

import numpy as np
from numpy.typing import DTypeLike, NDArray

__version__: str

Mode = Literal["field", "parametric", "shared", "power", "paper"]
Path = Union[str, "os.PathLike[str]"]
Column = Union[NDArray[np.float64], NDArray[np.float32]]
Track = Union[float, Column]
Point = Union[Sequence[float], NDArray[np.float64], Mapping[str, float]]

class ShagreenError(ValueError):
    """A file, a value or a request that cannot be used; the text says why, and what to do."""

class ShagreenWarning(UserWarning):
    """Something is not quite as requested; the text says what."""

class Tap(TypedDict):
    """Tap transient `A exp(-B t) sin(2π f t)`."""

    frequency_hz: float
    decay_per_s: float
    amplitude_mps2: float

class Texture:
    """A texture: what a surface does to a tip at every speed and force. It never changes."""

    @staticmethod
    def from_nodes(
        name: str,
        rate_hz: float,
        nodes: Union[NDArray[np.void], Mapping[str, Any]],
        *,
        friction: float | None = None,
        tap: Tap | None = None,
        license: str = "",
    ) -> Texture:
        """Creates a texture from nodes: a structured array with the fields of `nodes`, or a dictionary of arrays.

        `speed_mps` (m/s), `force_n` (N) and `level_mps2` (root mean square, m/s²) have the shape (n,), and `lsf_rad`
        (n, order): line spectral frequencies in rad, ascending in (0, π). `rate_hz` is the model rate, 200 to 4000 Hz.
        """

    @property
    def name(self) -> str: ...
    @property
    def id(self) -> str: ...
    @property
    def license(self) -> str: ...
    @property
    def origin(self) -> str: ...
    @property
    def provenance(self) -> Literal["free", "restricted"]: ...
    @property
    def rate_hz(self) -> float:
        """Model rate in Hz: the lowest rate of rendered samples."""

    @property
    def mode(self) -> Mode: ...
    @property
    def parents(self) -> dict[str, float]:
        """Contributing textures by id, with their weights, largest first."""

    @property
    def at(self) -> list[float] | None:
        """Authored point, one coordinate for each axis, 0 to 100."""

    @property
    def clamped(self) -> bool: ...
    @property
    def extrapolated(self) -> bool: ...
    @property
    def nodes(self) -> NDArray[np.void]:
        """Structured array of the shape (n,): `speed_mps`, `force_n`, `level_mps2` and `lsf_rad`."""

    @property
    def friction(self) -> float | None: ...
    @property
    def tap(self) -> Tap | None: ...
    def shaped(
        self,
        *,
        level: float = 0.0,
        grain: float = 1.0,
        brightness: float = 0.0,
        softness: float = 1.0,
        friction: float = 1.0,
        relief: float = 1.0,
        direction: float = 0.0,
    ) -> Texture:
        """Returns the texture in a shape: `level` in dB, `brightness` in dB/octave, `direction` in degrees."""

    def render(
        self,
        speed_mps: Track,
        force_n: Track,
        seconds: float | None = None,
        *,
        rate_hz: float | None = None,
        stroke_rate_hz: float | None = None,
        seed: int = 1,
        dtype: DTypeLike = np.float32,
    ) -> NDArray[Any]:
        """Renders the acceleration at the tip in m/s²: the samples of `shagreen render` with the same seed.

        Numbers need `seconds`. Arrays of the shape (n,) have `stroke_rate_hz` rows a second, by default `rate_hz`, and
        last from the first row to the last: n rows give n - 1 samples at their own rate.
        """

    def psd(
        self,
        speed_mps: float,
        force_n: float,
        *,
        frequencies_hz: Column | None = None,
        bins: int = 256,
        direction_deg: float = 0.0,
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Frequencies in Hz and the one-sided power spectral density of the noise in (m/s²)²/Hz, of the shape (n,)."""

    def level(self, speed_mps: float, force_n: float, *, direction_deg: float = 0.0) -> float:
        """Root mean square acceleration of the noise in m/s²."""

class Library:
    """Textures with positions in a space. It never changes."""

    @property
    def name(self) -> str: ...
    @property
    def description(self) -> str: ...
    @property
    def license(self) -> str: ...
    @property
    def ids(self) -> list[str]: ...
    @property
    def names(self) -> list[str]: ...
    @property
    def licenses(self) -> list[str]: ...
    @property
    def provenance(self) -> list[Literal["free", "restricted"]]: ...
    @property
    def axes(self) -> list[str]: ...
    @property
    def positions(self) -> NDArray[np.float64]:
        """Positions, 0 to 100, of the shape (textures, axes); NaN without a position."""

    @property
    def label_sources(self) -> list[Literal["human", "simulated", "physical", "estimated"] | None]: ...
    def known_axes(self) -> list[str]: ...
    def placed_on(self, axes: Sequence[str]) -> Library: ...
    def author(
        self,
        point: Point,
        *,
        mode: Mode = "field",
        natural: bool = False,
        extrapolate: bool = False,
        pinned: Sequence[str] | None = None,
        shape: Mapping[str, float] | None = None,
        name: str = "Authored",
    ) -> Texture:
        """Authors the texture at a point of the space, as `shagreen render --at` does."""

    def evaluate(
        self,
        modes: Union[Mode, Literal["all"], Sequence[Mode], None] = None,
        *,
        signals: int = 0,
        seconds: float = 16.0,
        seed: int = 1,
    ) -> dict[str, Any]:
        """Measures the leave-one-out error of the interpolation, as `shagreen evaluate leave-one-out` does.

        `error_db`, `level_error_db`, `shape_error_db`, `rank`, `nrs` and `signal_error_db` have the shape
        (methods, textures); `summary` has arrays of the shape (methods,).
        """

    def __len__(self) -> int: ...
    def __getitem__(self, id: str) -> Texture: ...
    def __contains__(self, id: object) -> bool: ...
    def __iter__(self) -> Iterator[str]: ...

class Project:
    """A project: its textures, and its authored textures by name or number."""

    @property
    def library(self) -> Library: ...
    @property
    def names(self) -> list[str]: ...
    def __len__(self) -> int: ...
    def __getitem__(self, name: str) -> Texture: ...
    def __iter__(self) -> Iterator[str]: ...

def load_library(path: Path | None = None) -> Library:
    """Loads a library: a file, a folder of library files, "starter" (the default) or "simulated"."""

def load_project(path: Path) -> Project:
    """Loads a project. A library outside its folder is read with a warning."""

def blend(
    textures: Sequence[Texture],
    weights: Sequence[float],
    *,
    mode: Literal["parametric", "shared", "power"] = "parametric",
    shape: Mapping[str, float] | None = None,
    name: str = "Blend",
) -> Texture:
    """Interpolates one to three textures with weights, which are divided by their sum."""

def fit(
    acceleration_mps2: Column,
    speed_mps: Track,
    force_n: Track,
    rate_hz: float,
    *,
    name: str = "Recording",
    license: str = "",
    model_rate_hz: float | None = None,
    order: int | None = None,
) -> tuple[Texture, dict[str, Any]]:
    """Fits a texture to a recorded stroke, as `shagreen import recording` does. The second result is a report.

    `acceleration_mps2` has the shape (n,), or (n, axes) with up to three axes; `speed_mps` and `force_n` (n,).
    """

def quality(
    reference: Column,
    test: Column,
    rate_hz: float,
    *,
    threshold: Literal["held-tool", "pacinian", "composite"] | None = None,
    model: Path | None = None,
) -> dict[str, Any]:
    """Compares a signal with a reference in m/s², as `shagreen quality` does. No person rated the prediction.

    `model` is a file of `shagreen quality fit`; without it, the built-in model predicts d'.
    """

def difference(a: Texture, b: Texture) -> dict[str, float]:
    """Measures the spectral difference of two textures in dB, as the leave-one-out evaluation does."""

def predict_attributes(texture: Texture, library: Library | None = None) -> dict[str, Any]:
    """Predicts the attributes of a texture, 0 to 100, from those of a library (by default "simulated")."""

def predict_photo(photo: Union[Path, NDArray[np.uint8]]) -> dict[str, Any]:
    """Predicts the attributes of a surface from a photo: a path, or an array of the shape (height, width, 3)."""

def predict_prompt(prompt: str) -> dict[str, Any]:
    """Predicts the attributes of a surface, 0 to 100, from a description in words."""

def export(texture: Texture, format: str, path: Path) -> dict[str, Any]:
    """Exports a texture in the format of another program (`export_formats`)."""

def export_formats() -> list[dict[str, str]]:
    """Export formats of textures: dictionaries with `id`, `name`, `ending` and `help`."""
