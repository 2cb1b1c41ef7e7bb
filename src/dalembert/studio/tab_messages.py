"""Messages of a tab: read from JSON, and refused with a sentence."""

from __future__ import annotations

import json
from typing import Any

from dalembert.errors import DalembertError, ModelError


def read_message(text: str) -> Any:
    """The message of a text; raises ModelError for what is not JSON."""
    try:
        return json.loads(text)
    except (ValueError, RecursionError):
        raise ModelError("the message is not JSON", "reload the page") from None


def sentence(error: Exception) -> str:
    """The sentence of an error, without the file's name; of a fault of the program, what to do."""
    if isinstance(error, ModelError):
        return f"{error.what}; {error.remedy}" if error.remedy else error.what
    if isinstance(error, DalembertError):
        return str(error)
    return f"the studio failed ({type(error).__name__}); please report what you did"
