"""Archives to send, good and bad."""

import io
import struct
import zipfile


def packed(files, how=zipfile.ZIP_DEFLATED):
    """A zip archive of names (or `ZipInfo`) and contents."""
    into = io.BytesIO()
    with zipfile.ZipFile(into, "w", how) as archive:
        for name, content in files:
            archive.writestr(name, content)
    return into.getvalue()


def member(name, mode=0, flags=0):
    """A member of an archive with the mode of a file of Unix."""
    info = zipfile.ZipInfo(name)
    info.external_attr = mode << 16
    info.flag_bits |= flags
    return info


def with_flag(archive, flag):
    """The same archive, every member said to have a flag (1: encrypted)."""
    data = bytearray(archive)
    at = data.find(b"PK\x01\x02")
    while at >= 0:
        (flags,) = struct.unpack_from("<H", data, at + 8)
        struct.pack_into("<H", data, at + 8, flags | flag)
        at = data.find(b"PK\x01\x02", at + 4)
    return bytes(data)


def said_larger(archive, size):
    """The same archive, its directory said to be of this size."""
    data = bytearray(archive)
    struct.pack_into("<L", data, data.rfind(b"PK\x05\x06") + 12, size)
    return bytes(data)


def bomb(copies):
    """An archive whose members are all the same bytes: its size stays that of one."""
    one = packed([("0", b"\0" * 10**6)])
    directory = one[one.find(b"PK\x01\x02") : one.rfind(b"PK\x05\x06")]
    start = one.find(b"PK\x01\x02")
    entries = b"".join(_renamed(directory, f"{n:04d}") for n in range(copies))
    end = struct.pack("<4s4H2LH", b"PK\x05\x06", 0, 0, copies, copies, len(entries), start, 0)
    return one[:start] + entries + end


def _renamed(entry, name):
    head = bytearray(entry[:46])
    struct.pack_into("<H", head, 28, len(name))
    return bytes(head) + name.encode()
