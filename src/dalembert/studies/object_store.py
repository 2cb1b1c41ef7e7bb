"""A store of a study at an address, as ``s3://bucket/pump.zarr``: any that fsspec knows, by obstore if it is installed.

A rename cannot complete it, so its group's attributes are written last. A system lock cannot protect it, so a lease
beside it, ``pump.zarr.lock/N``, is renewed during the run, and another run acquires it when it has expired.
"""

from __future__ import annotations

import json
import os
import re
import secrets
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from typing import Any, Protocol

from dalembert.errors import ModelError
from dalembert.saving import check_installed
from dalembert.studies.store_folder import this_run

LEASE = 60.0
"""Seconds after which a run that no longer renews its lease counts as dead; clocks agree to better than this."""
RENEWALS = 4
"""Renewals in this time."""
BY_OBSTORE = ("s3", "s3a", "gs", "az", "adl", "abfs", "abfss", "azure")
"""Protocols that obstore serves where fsspec's package for them is missing."""


class Backend(Protocol):
    """Objects by key below an address."""

    errors: tuple[type[Exception], ...]

    def group(self, name: str) -> Any: ...

    def read(self, key: str) -> bytes | None: ...

    def write(self, key: str, data: bytes, new: bool = False) -> None: ...

    def remove(self, keys: list[str]) -> None: ...

    def keys(self, prefix: str) -> list[str]: ...


class ByFsspec:
    """Objects of a file system of fsspec; on a disk each is written beside and renamed, so that none is cut."""

    errors: tuple[type[Exception], ...] = (OSError,)

    def __init__(self, address: str) -> None:
        from fsspec.core import url_to_fs

        self.address = address
        self.fs, self.root = url_to_fs(address)
        self.local = "file" in self.fs.protocol

    def group(self, name: str) -> Any:
        """The store that zarr uses for the group of a name."""
        from zarr.storage import FsspecStore

        return self._path(name) if self.local else FsspecStore.from_url(f"{self.address.rstrip('/')}/{name}")

    def _path(self, key: str) -> str:
        return f"{self.root.rstrip('/')}/{key}"

    def read(self, key: str) -> bytes | None:
        try:
            return bytes(self.fs.cat_file(self._path(key)))
        except FileNotFoundError:
            return None

    def write(self, key: str, data: bytes, new: bool = False) -> None:
        """Raises FileExistsError for a new object that exists."""
        path = self._path(key)
        if not self.local:
            self.fs.pipe_file(path, data, **({"mode": "create"} if new else {}))
            return
        self.fs.makedirs(self.fs._parent(path), exist_ok=True)
        beside = f"{path}.{secrets.token_hex(4)}.partial"
        with open(beside, "xb") as file:
            file.write(data)
        try:
            (os.link if new else os.replace)(beside, path)
        finally:
            if new:
                os.unlink(beside)

    def remove(self, keys: list[str]) -> None:
        for key in keys:
            try:
                self.fs.rm_file(self._path(key))
            except FileNotFoundError:
                continue

    def keys(self, prefix: str) -> list[str]:
        self.fs.invalidate_cache()
        try:
            paths = self.fs.find(self._path(prefix))
        except FileNotFoundError:
            return []
        paths = (path[len(self._path("")) :] for path in paths if not path.endswith(".partial"))
        return sorted(paths)


class ByObstore:
    """Objects of a store of obstore."""

    def __init__(self, address: str) -> None:
        import obstore

        self.errors: tuple[type[Exception], ...] = (OSError, obstore.exceptions.BaseError)
        self.address, self.store = address, obstore.store.from_url(address)

    def group(self, name: str) -> Any:
        """The store that zarr uses for the group of a name."""
        from obstore.store import from_url
        from zarr.storage import ObjectStore

        return ObjectStore(from_url(f"{self.address}/{name}"))

    def read(self, key: str) -> bytes | None:
        import obstore

        try:
            return bytes(obstore.get(self.store, key).bytes())
        except FileNotFoundError:
            return None

    def write(self, key: str, data: bytes, new: bool = False) -> None:
        import obstore

        try:
            obstore.put(self.store, key, data, mode="create" if new else "overwrite")
        except obstore.exceptions.AlreadyExistsError:
            raise FileExistsError(key) from None

    def remove(self, keys: list[str]) -> None:
        import obstore

        for key in keys:
            try:
                obstore.delete(self.store, key)
            except FileNotFoundError:
                continue

    def keys(self, prefix: str) -> list[str]:
        import obstore

        return sorted(one["path"] for some in obstore.list(self.store, prefix) for one in some)


def is_address(target: object) -> bool:
    """True if this is the address of an object store, not a path.

    >>> is_address("memory://pump.zarr"), is_address("runs/pump.zarr")
    (True, False)
    """
    return isinstance(target, str) and re.match(r"[a-z][a-z0-9+.-]+(::|://)", target) is not None


def backend(above: str, address: str) -> Backend:
    """Backend of an address, below ``above``: fsspec, or obstore where fsspec lacks the package."""
    check_installed("fsspec", f"a study at {address}", "cloud")
    try:
        return ByFsspec(above)
    except ImportError as error:
        if address.partition("://")[0] in BY_OBSTORE:
            if find_spec("obstore"):
                return ByObstore(above)
            what, remedy = "the package obstore", "pip install 'dalembert[cloud]'"
        else:
            what, remedy = f"a package ({str(error).lower()})", "pip install it"
        raise ModelError(f"a study at {address} needs {what}, which is not installed", remedy) from None
    except ValueError as error:
        known = "memory://, file://, s3://, gs://, az:// and others"
        raise ModelError(f"{address}: {str(error).lower()}", f"fsspec knows {known}") from None


class Objects:
    """A group of objects below an address; raises ModelError where it cannot be reached."""

    def __init__(self, address: str, serve: Callable[[str, str], Backend] = backend) -> None:
        self.address = address.rstrip("/")
        above, _, self.name = self.address.rpartition("/")
        if not self.name or (above.endswith((":", ":/")) and not address.startswith("memory:")):
            raise ModelError(f"{address} names no place for a store", "write s3://bucket/pump.zarr")
        self.objects = serve(f"{above}/" if above.endswith("/") else above, self.address)
        self.errors = self.objects.errors
        self._lease: Lease | None = None

    def __str__(self) -> str:
        return self.address

    def group(self) -> Any:
        """The store that zarr uses for the group."""
        return self.objects.group(self.name)

    def exists(self) -> bool:
        """True if a complete study exists; raises ModelError where something else exists.

        An incomplete one has a group with this program's name in its attributes, and no `blocks_of`, written last.
        """
        with self._reached():
            metadata = self.objects.read(f"{self.name}/zarr.json")
            if metadata is None and not self.objects.keys(f"{self.name}/"):
                return False
        try:
            attributes = json.loads(metadata or b"{}").get("attributes", {})
        except ValueError:
            attributes = {}
        if "dalembert" not in attributes:
            raise ModelError(f"{self} exists and is not a study", "give another name")
        return "blocks_of" in attributes

    def create(self, fill: Callable[[Any], None]) -> None:
        """Creates it in place, after removing an incomplete one."""
        self.objects.remove(self.objects.keys(f"{self.name}/"))
        fill(self.group())

    def remove(self, key: str) -> None:
        """Deletes a chunk, if it exists."""
        self.objects.remove([f"{self.name}/{key}"])

    def sweep(self) -> None:
        """Objects are written as a unit: a partly written one never counts."""

    def check(self) -> None:
        """Raise ModelError where another run has taken the lease."""
        if self._lease is not None:
            self._lease.check()

    @contextmanager
    def locked(self) -> Iterator[None]:
        """One run at a time, by a lease that is renewed as long as it is held."""
        with self._reached():
            self._lease = Lease(self.address, self.objects, f"{self.name}.lock/")
        try:
            yield
        finally:
            self._lease.release()
            self._lease = None

    @contextmanager
    def _reached(self) -> Iterator[None]:
        try:
            yield
        except ModelError:
            raise
        except Exception as error:  # whatever a service, its credentials or the network say
            lines = str(error).strip().splitlines() or [type(error).__name__]
            raise ModelError(
                f"{self} cannot be reached: {lines[0]}", "see the address, the credentials and the network"
            ) from None


class Lease:
    """The right to write a store until a time, renewed by a thread.

    Its objects are numbered: the creator of the one after the last, which must be released or expired, holds it.
    """

    def __init__(self, address: str, objects: Backend, folder: str) -> None:
        self.address, self.objects, self.folder = address, objects, folder
        self.who, self.token, self.lost = this_run(), secrets.token_hex(8), ""
        last, held = self._last()
        if held and float(held["until"]) > time.time():
            self._refuse(held)
        self.key = f"{folder}{last + 1:08d}"
        try:
            objects.write(self.key, self._record(), new=True)
        except FileExistsError:
            self._refuse(self._last()[1])
        if (holder := self._last()[1]).get("token") != self.token:  # where nothing is created exclusively
            self._refuse(holder)
        objects.remove([key for key in objects.keys(folder) if key < self.key])
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._renew, daemon=True)
        self._thread.start()

    def _record(self, seconds: float | None = None) -> bytes:
        self.until = time.time() + (LEASE if seconds is None else seconds)
        return json.dumps({"who": self.who, "token": self.token, "until": self.until}).encode()

    def _last(self) -> tuple[int, dict[str, Any]]:
        """Number of the last one, and what it says; nothing where there is none."""
        keys = self.objects.keys(self.folder)
        text = self.objects.read(keys[-1]) if keys else None
        try:
            record = dict(json.loads(text)) if text else {}
        except ValueError:  # cut, where a file system does not write whole files
            record = {}
        return int(keys[-1].rpartition("/")[2]) if keys else 0, record

    def _refuse(self, held: dict[str, Any]) -> None:
        end = time.strftime("%H:%M:%S", time.localtime(float(held.get("until", time.time() + LEASE))))
        who = held.get("who", "another process")
        raise ModelError(
            f"{self.address} is being written by {who}, whose lease ends at {end} if it is not renewed",
            "wait for it, or end it; one that died is taken over after that time",
        )

    def _renew(self) -> None:
        while not self._ended.wait(LEASE / RENEWALS):
            try:
                held = self._last()[1]
                if held.get("token") != self.token:
                    self.lost = str(held.get("who", "another process"))
                    return
                self.objects.write(self.key, self._record())
            except Exception:  # tried again until the lease has ended: the network may come back
                continue

    def check(self) -> None:
        """Raise ModelError where it has ended, or another run has it."""
        if self.lost or time.time() > self.until:
            whose = f"is {self.lost}'s now" if self.lost else "could not be renewed in time"
            raise ModelError(f"the lease of {self.address} {whose}", "finished blocks are kept: resume later")

    def release(self) -> None:
        """Let it go; the object stays, so that the numbers go on."""
        self._ended.set()
        self._thread.join()
        try:
            if self._last()[1].get("token") == self.token:
                self.objects.write(self.key, self._record(-1.0))
        except Exception:  # of a store that is gone: it ends by itself
            return
