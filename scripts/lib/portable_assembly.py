# SPDX-License-Identifier: MIT
"""Takes the machine code for Windows out of .NET assemblies, so that the .NET runtime of any system runs them.

Usage: portable_assembly.py ASSEMBLY.dll...
Assemblies that come with the .NET SDK hold their methods twice: as portable code, and compiled ahead for one processor and system
("ReadyToRun"). A runtime of another system refuses such a file as a whole. This marks what is portable as all there is (ECMA-335,
II.25.3.3: Flags and ManagedNativeHeader) and drops what only the machine code needs."""

import struct
import sys
from pathlib import Path

ONLY_PORTABLE, IS_LIBRARY_OF_MACHINE_CODE = 0x1, 0x4
EXPORTS, IMPORTS, EXCEPTIONS, RELOCATIONS, IMPORT_ADDRESSES, CLI = 0, 1, 3, 5, 12, 14  # directories of a PE32+ file


def make_portable(path):
    data = bytearray(path.read_bytes())
    pe = struct.unpack_from("<I", data, 0x3C)[0]
    section_count, optional_size = struct.unpack_from("<H", data, pe + 6)[0], struct.unpack_from("<H", data, pe + 20)[0]
    optional = pe + 24
    if data[:2] != b"MZ" or data[pe : pe + 4] != b"PE\0\0" or struct.unpack_from("<H", data, optional)[0] != 0x20B:
        sys.exit(f"{path} is no assembly of 64 bits")
    directory = optional + 112
    cli_address = struct.unpack_from("<I", data, directory + 8 * CLI)[0]
    for i in range(section_count):
        virtual_size, address, raw_size, raw = struct.unpack_from("<IIII", data, optional + optional_size + 40 * i + 8)
        if address <= cli_address < address + max(virtual_size, raw_size):
            cli = raw + cli_address - address
            break
    else:
        sys.exit(f"{path} is no assembly: it has no CLI header")
    flags = struct.unpack_from("<I", data, cli + 16)[0]
    if flags & ONLY_PORTABLE:
        return
    struct.pack_into("<I", data, cli + 16, (flags | ONLY_PORTABLE) & ~IS_LIBRARY_OF_MACHINE_CODE)
    struct.pack_into("<II", data, cli + 64, 0, 0)  # ManagedNativeHeader
    for each in (EXPORTS, IMPORTS, EXCEPTIONS, RELOCATIONS, IMPORT_ADDRESSES):
        struct.pack_into("<II", data, directory + 8 * each, 0, 0)
    path.write_bytes(data)


for name in sys.argv[1:]:
    make_portable(Path(name))
