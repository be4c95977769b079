# SPDX-License-Identifier: MIT
extends RefCounted
## The colors of the game, in one place: a night in indigo, what lives in it bright, what hurts in red.

const SKY: Array[Color] = [Color("141433"), Color("2c2a63"), Color("6d4a8f"), Color("d98a94")]
const HILLS: Array[Color] = [Color("4b3f80"), Color("3a3370"), Color("2b285c")]
const CAVE: Array[Color] = [Color("0f0d26"), Color("1b1638"), Color("2b2150"), Color("3a2a5c")]
const CAVE_HILLS: Array[Color] = [Color("2f2558"), Color("271e4b"), Color("1f183e")]
const GLOW_WORM := Color("8ff5e0")
const MOON := Color("fff2cc")

const GROUND := Color("34366e")
const GROUND_DEEP := Color("17173b")
const GROUND_RIM := Color("9aa2ec")
const GRASS := Color("5a64b8")
const PLATFORM := Color("6a5aa8")
const PLATFORM_RIM := Color("d3bdff")

const JELLY := Color("7df0b0")
const JELLY_DARK := Color("15604f")
const CUSHION := Color("ffa45c")
const CUSHION_DARK := Color("a3512a")
const BOULDER := Color("62b6f5")
const BOULDER_DARK := Color("24508f")
const BRIDGE := Color("ffd36b")
const BRIDGE_DARK := Color("9a6a2c")

const STAR := Color("ffe27a")
const STAR_DARK := Color("d68f2e")
const THORN := Color("ff4f6d")
const THORN_DARK := Color("7d1a4a")
const WIND := Color("c9e8ff")

const INK := Color("1b1b3f")
const TEXT := Color("f4f1ff")
const TEXT_SOFT := Color("b9b6e6")
const ACCENT := Color("7df0b0")
