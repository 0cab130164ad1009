"""Which function carries which equation number."""

from collections.abc import Callable
from typing import TypeVar

Transcription = TypeVar("Transcription", bound=Callable[..., object] | type)

TRANSCRIBED: dict[int, list[str]] = {}
"""Equation number -> the functions and classes that transcribe it, filled as their modules are imported."""


def equation(*numbers: int) -> Callable[[Transcription], Transcription]:
    """Mark a function or class as the transcription of the equations with these numbers."""

    def mark(transcription: Transcription) -> Transcription:
        for number in numbers:
            TRANSCRIBED.setdefault(number, []).append(f"{transcription.__module__}.{transcription.__qualname__}")
        return transcription

    return mark
