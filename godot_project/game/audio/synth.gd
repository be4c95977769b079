# SPDX-License-Identifier: MIT
extends RefCounted
## Makes the sounds of the game out of numbers: no recorded file, nothing fetched.
##
## A sound is a pitch that glides, a shape of loudness, some overtones and some noise, as 16 bit samples.

const RATE := 22050 # samples a second
const MUSIC_RATE := 11025


## A gliding tone: `from` and `to` in Hz, `duration` in s, `overtone` and `noise` from 0 to 1, `wobble` in Hz of vibrato.
static func glide(from: float, to: float, duration: float, loudness := 0.5, overtone := 0.2, noise := 0.0,
		wobble := 0.0) -> AudioStreamWAV:
	var count := int(duration * RATE)
	var samples := PackedFloat32Array()
	samples.resize(count)
	var random := RandomNumberGenerator.new()
	random.seed = 7
	var phase := 0.0
	var hiss := 0.0
	for i in count:
		var t := i / float(count)
		var pitch := lerpf(from, to, t * (2 - t))
		if wobble > 0:
			pitch *= 1 + 0.12 * sin(TAU * wobble * i / RATE)
		phase += pitch / RATE
		hiss = lerpf(hiss, random.randf_range(-1, 1), 0.25) # a soft low pass: wet, not sharp
		var tone := sin(TAU * phase) + overtone * sin(2 * TAU * phase)
		var shape := minf(t * 40, 1) * pow(1 - t, 1.6)
		samples[i] = loudness * shape * lerpf(tone, 2.5 * hiss, noise)
	return to_stream(samples, RATE)


## Bells: frequencies in Hz that follow one another every `gap` s and ring on.
static func bells(pitches: PackedFloat32Array, gap: float, ring: float, loudness := 0.35) -> AudioStreamWAV:
	var count := int((gap * (pitches.size() - 1) + ring) * RATE)
	var samples := PackedFloat32Array()
	samples.resize(count)
	for k in pitches.size():
		add_bell(samples, RATE, k * gap, pitches[k], ring, loudness)
	return to_stream(samples, RATE)


## Adds a struck tone with two overtones that die away sooner.
static func add_bell(samples: PackedFloat32Array, rate: int, start: float, pitch: float, ring: float,
		loudness: float) -> void:
	var first := int(start * rate)
	var count := mini(int(ring * rate), samples.size() - first)
	var step := TAU * pitch / rate
	var fade := exp(-5.0 / (ring * rate))
	var level := loudness
	for i in count:
		var strike := minf(i * 0.02, 1)
		samples[first + i] += strike * level * (sin(i * step) + 0.3 * level * sin(3.0 * i * step))
		level *= fade


## Adds a held tone that swells and sinks: what the music lies on.
static func add_pad(samples: PackedFloat32Array, rate: int, start: float, pitch: float, duration: float,
		loudness: float) -> void:
	var first := int(start * rate)
	var count := int(duration * rate)
	var step := TAU * pitch / rate
	for i in count:
		var swell := sin(PI * i / count)
		samples[(first + i) % samples.size()] += loudness * swell * (sin(i * step) + 0.4 * sin(i * step * 1.005))


## A loop of 19.2 s over four chords, slow enough to forget.
static func music() -> AudioStreamWAV:
	const BAR := 2.4
	const CHORDS: Array = [[0, 7, 16], [-3, 4, 12], [5, 12, 21], [-5, 2, 11]]
	const TUNE: Array = [
		[24, -1, 28, -1, 31, -1, 28, 26], [24, -1, 21, -1, 19, -1, -1, -1],
		[29, -1, 28, -1, 24, -1, 26, 28], [26, -1, -1, -1, 23, -1, 19, -1],
		[24, -1, 28, -1, 36, -1, 35, 31], [33, -1, 28, -1, 24, -1, -1, -1],
		[29, -1, 33, -1, 31, -1, 28, 26], [23, -1, 26, -1, 31, -1, -1, -1],
	]
	var samples := PackedFloat32Array()
	samples.resize(int(BAR * TUNE.size() * MUSIC_RATE))
	for bar in TUNE.size():
		for note: int in CHORDS[bar % 4]:
			add_pad(samples, MUSIC_RATE, bar * BAR, pitch_of(note), BAR * 1.3, 0.07)
		for beat in 8:
			var note: int = TUNE[bar][beat]
			if note >= 0:
				add_bell(samples, MUSIC_RATE, bar * BAR + beat * BAR / 8, pitch_of(note), 1.1, 0.1)
	var stream := to_stream(samples, MUSIC_RATE)
	stream.loop_mode = AudioStreamWAV.LOOP_FORWARD
	stream.loop_end = samples.size()
	return stream


## Half tones above the C below middle C, in Hz.
static func pitch_of(note: int) -> float:
	return 130.81 * pow(2, note / 12.0)


static func to_stream(samples: PackedFloat32Array, rate: int) -> AudioStreamWAV:
	var bytes := PackedByteArray()
	bytes.resize(2 * samples.size())
	for i in samples.size():
		bytes.encode_s16(2 * i, int(clampf(samples[i], -1, 1) * 32767))
	var stream := AudioStreamWAV.new()
	stream.format = AudioStreamWAV.FORMAT_16_BITS
	stream.mix_rate = rate
	stream.data = bytes
	return stream
