"""A photograph as light: read, turned upright, and on a scale that adds."""

import io
import math
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray
from PIL import ExifTags, Image, ImageOps, UnidentifiedImageError

from wearsim.errors import CaseError, Fault
from wearsim.files import check_given

_MOST_BYTES = 1_000_000_000
"""Of a picture: a TIFF has all its pixels as they are."""

MOST_PIXELS = 80_000_000
"""Pixels of the largest picture that is decoded: it takes about 1 GB meanwhile, and 8 s."""

FEWEST_PIXELS = 200
"""Pixels of the smaller side below which no tooth is measured."""

_FORMATS = ("PNG", "JPEG", "TIFF")

Light = NDArray[np.float32]
Codes = NDArray[np.uint8 | np.uint16]


@dataclass(frozen=True, eq=False)
class Photograph:
    """A picture in shades of grey."""

    name: str  # of its file
    light: Light  # from 0 to 1, linear in the light that came in, shape (height, width)
    focal_length: float | None = None  # as the camera noted it [px]

    @property
    def width(self) -> int:
        """Pixels across."""
        return int(self.light.shape[1])

    @property
    def height(self) -> int:
        """Pixels down."""
        return int(self.light.shape[0])


def read_photograph(path: Path) -> Photograph:
    """Return the picture in a file; raise CaseError for what is none, is damaged, too large or too small."""
    try:
        check_given(path, _MOST_BYTES)
    except OSError as error:
        text = f"must be a picture, but cannot be opened ({error.strerror}): check the path"
        raise bad_photograph(str(path), text) from None
    with _faults(path), path.open("rb") as file:
        return _decoded(file, path)


def photograph_of(content: bytes, name: str) -> Photograph:
    """Return the picture that a file of some name holds; raise CaseError as `read_photograph` does."""
    path = Path(name)
    with _faults(path):
        return _decoded(io.BytesIO(content), path)


def _decoded(file: BinaryIO, path: Path) -> Photograph:
    """Return the picture in an open file."""
    with Image.open(file, formats=_FORMATS) as picture:
        _check_size(picture, path)
        _check_kind(picture, path)
        picture.load()
        focal_length = _focal_length(picture)
        grey = _grey(ImageOps.exif_transpose(picture))
    return Photograph(path.name, _linear(grey), focal_length)


def bad_photograph(name: str, message: str) -> CaseError:
    """Return the error of a picture that cannot be measured."""
    return CaseError([Fault(message, "", name)])


@contextmanager
def _faults(path: Path) -> Iterator[None]:
    """Say what is wrong with a file in the words of its user."""
    try:
        with warnings.catch_warnings():
            # What is too large is refused by its header, and odd tags of a camera do no harm.
            warnings.simplefilter("ignore")
            yield
    except CaseError:
        raise
    except (FileNotFoundError, IsADirectoryError, PermissionError) as error:
        text = f"must be a picture, but cannot be opened ({error.strerror}): check the path"
        raise bad_photograph(str(path), text) from None
    except Image.DecompressionBombError:
        raise bad_photograph(str(path), _too_large("it has more")) from None
    except UnidentifiedImageError:
        text = "must be a PNG, JPEG or TIFF picture, but is none of them: save it as one"
        raise bad_photograph(str(path), text) from None
    except (OSError, SyntaxError, ValueError) as error:
        text = f"must be a whole picture, but cannot be decoded ({error}): copy it from the camera again"
        raise bad_photograph(str(path), text) from None


def _check_size(picture: Image.Image, path: Path) -> None:
    width, height = picture.size
    if width * height > MOST_PIXELS:
        raise bad_photograph(str(path), _too_large(f"it has {width} x {height}"))
    if min(width, height) < FEWEST_PIXELS:
        text = (
            f"must be at least {FEWEST_PIXELS} pixels wide and high, but has {width} x {height}: "
            "take the picture that the camera saved, not a preview"
        )
        raise bad_photograph(str(path), text)


def _check_kind(picture: Image.Image, path: Path) -> None:
    # A telephone's JPEG may hold more pictures: the first one is the photograph.
    pages = 1 if picture.format in ("JPEG", "MPO") else getattr(picture, "n_frames", 1)
    if pages > 1:
        text = f"must be one picture, but holds {pages}: save that of the wheel alone"
        raise bad_photograph(str(path), text)
    if picture.mode == "F":
        text = "must have 8 or 16 bits per channel, but has floating-point numbers: save it as PNG"
        raise bad_photograph(str(path), text)


def _too_large(found: str) -> str:
    return (
        f"must have at most {MOST_PIXELS // 1_000_000} million pixels, but {found}: crop it to the wheel, or "
        "save it smaller"
    )


def _grey(picture: Image.Image) -> Codes:
    """Shades of grey as the file codes them; what is transparent is white."""
    if picture.mode.startswith("I"):
        return np.array(np.clip(np.asarray(picture), 0, 65535), dtype=np.uint16)
    if picture.has_transparency_data:
        picture = picture.convert("RGBA")
        white = Image.new("L", picture.size, "white")
        white.paste(picture.convert("L"), mask=picture.getchannel("A"))
        picture = white
    return np.array(picture.convert("L"), dtype=np.uint8)


def _focal_length(picture: Image.Image) -> float | None:
    """Return the focal length by that noted for a picture of 24 x 36 mm [px]; None where none is noted."""
    noted = picture.getexif().get_ifd(ExifTags.IFD.Exif).get(ExifTags.Base.FocalLengthIn35mmFilm)
    if not isinstance(noted, int) or noted <= 0:
        return None
    return noted * math.hypot(*picture.size) / math.hypot(24.0, 36.0)


def _linear(grey: Codes) -> Light:
    """Light that codes of sRGB stand for: there an edge out of focus is half way where the edge is."""
    coded = np.linspace(0.0, 1.0, np.iinfo(grey.dtype).max + 1)
    light = np.where(coded <= 0.04045, coded / 12.92, ((coded + 0.055) / 1.055) ** 2.4)
    return np.asarray(light.astype(np.float32)[grey])
