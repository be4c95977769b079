# SPDX-License-Identifier: MIT
"""What a library is by its first bytes: of which system and processor, and whether Apple's systems would take it.

Sources: System V ABI (ELF), Microsoft's PE Format, Apple's <mach-o/loader.h> and <mach-o/fat.h>, the WebAssembly core specification."""

import struct

from addon_files import ENTRY

ELF_MACHINES = {"x86_64": 62, "arm64": 183}
PE_MACHINES = {"x86_64": 0x8664, "arm64": 0xAA64}
MACH_CPUS = {0x01000007: "x86_64", 0x0100000C: "arm64"}
SHARED_OBJECT, PE_IS_DLL, MACH_DYLIB, CODE_SIGNATURE = 3, 0x2000, 6, 0x1D


def fault_of_elf(content, arch):
    if content[:6] != b"\x7fELF\x02\x01" or len(content) < 64:
        return "is no 64-bit library of Linux or Android"
    kind, machine = struct.unpack_from("<HH", content, 16)
    if kind != SHARED_OBJECT:
        return "is no shared library"
    return None if machine == ELF_MACHINES[arch] else f"is not for {arch}: its machine is {machine}"


def fault_of_pe(content, arch):
    at = struct.unpack_from("<I", content, 0x3C)[0] if content[:2] == b"MZ" and len(content) > 0x40 else -1
    if at < 0 or content[at:at + 4] != b"PE\0\0" or len(content) < at + 24:
        return "is no library of Windows"
    machine, flags = struct.unpack_from("<H", content, at + 4)[0], struct.unpack_from("<H", content, at + 22)[0]
    if not flags & PE_IS_DLL:
        return "is no DLL"
    return None if machine == PE_MACHINES[arch] else f"is not for {arch}: its machine is {machine:#x}"


def fault_of_slice(content, name):
    """The fault of one processor's part of a library for macOS. Apple's processors run none that is not signed, ad hoc at least."""
    if len(content) < 32 or struct.unpack_from("<I", content)[0] != 0xFEEDFACF:
        return f"holds no 64-bit code for {name}"
    kind, commands = struct.unpack_from("<I", content, 12)[0], struct.unpack_from("<I", content, 16)[0]
    if kind != MACH_DYLIB:
        return f"is no dynamic library for {name}"
    at = 32
    for _ in range(commands):
        if at + 8 > len(content):
            return f"ends within its part for {name}"
        command, size = struct.unpack_from("<II", content, at)
        if command == CODE_SIGNATURE:
            return None
        at += max(size, 8)
    return f"is not signed for {name}: sign it ad hoc, by codesign --sign -"


def fault_of_mach(content):
    if len(content) < 8 or struct.unpack_from(">I", content)[0] != 0xCAFEBABE:
        return "is no universal library of macOS"
    found = set()
    for i in range(min(struct.unpack_from(">I", content, 4)[0], 8)):
        if len(content) < 28 + 20 * i:
            return "ends within its list of processors"
        cpu, _, offset, size, _ = struct.unpack_from(">5I", content, 8 + 20 * i)
        name = MACH_CPUS.get(cpu, f"processor {cpu:#x}")
        found.add(name)
        if fault := fault_of_slice(content[offset:offset + size], name):
            return fault
    missing = set(MACH_CPUS.values()) - found
    return f"has no code for {', '.join(sorted(missing))}" if missing else None


def fault_of_library(content, key):
    """What is wrong with the library of a key of the `.gdextension`, after "The library …". None if nothing is."""
    system, arch = key.split(".")[0], key.split(".")[-1]
    if system in ("linux", "android"):
        fault = fault_of_elf(content, arch)
    elif system == "windows":
        fault = fault_of_pe(content, arch)
    elif system == "macos":
        fault = fault_of_mach(content)
    else:
        fault = None if content[:8] == b"\0asm\1\0\0\0" else "is no WebAssembly of version 1"
    if fault is None and ENTRY.encode() not in content:
        fault = f"has no function {ENTRY}: Godot could not start it"
    return fault
