"""Building blocks of tools/synthesize_sounds.py: noise, filters, resonators, envelopes. Samples are lists of floats,
filters return new lists, and `add` sums into one. Standard library only; the same seed gives the same samples.
"""
import math
import pathlib
import random
import wave

RATE = 22050  # samples per second
FULL = 32767


def samples(seconds):
    return int(seconds * RATE)


def noise(rng, count):
    return [rng.uniform(-1, 1) for _ in range(count)]


def decay(signal, seconds, attack=0.001):
    """Rises within `attack` seconds, then falls to 1/e in `seconds`."""
    rise = max(1, samples(attack))
    factor, level, out = math.exp(-1 / (seconds * RATE)), 1.0, []
    for k, value in enumerate(signal):
        if k < rise:
            out.append(value * k / rise)
        else:
            out.append(value * level)
            level *= factor
    return out


def swell(signal, peak=0.4):
    """Rises to `peak` of its length and falls, both as half a cosine."""
    count = len(signal)
    top = max(1.0, peak * count)

    def level(k):
        share = k / top if k < top else (count - k) / (count - top)
        return 0.5 - 0.5 * math.cos(math.pi * share)
    return [value * level(k) for k, value in enumerate(signal)]


def biquad(signal, b0, b1, b2, a1, a2, turns=1):
    """`turns` = 2: for a looping signal, in its steady state."""
    out = []
    x1 = x2 = y1 = y2 = 0.0
    for _ in range(turns):
        out = []
        for x in signal:
            y = b0 * x + b1 * x1 + b2 * x2 - a1 * y1 - a2 * y2
            x2, x1, y2, y1 = x1, x, y1, y
            out.append(y)
    return out


def coefficients(kind, frequency, q):
    """Robert Bristow-Johnson's second-order filters."""
    w = 2 * math.pi * min(frequency, 0.45 * RATE) / RATE
    cosine, alpha = math.cos(w), math.sin(w) / (2 * q)
    if kind == "low":
        b = [(1 - cosine) / 2, 1 - cosine, (1 - cosine) / 2]
    elif kind == "high":
        b = [(1 + cosine) / 2, -(1 + cosine), (1 + cosine) / 2]
    else:
        b = [alpha, 0, -alpha]
    return [value / (1 + alpha) for value in (*b, -2 * cosine, 1 - alpha)]


def low(signal, frequency, q=0.707, turns=1):
    return biquad(signal, *coefficients("low", frequency, q), turns)


def high(signal, frequency, q=0.707, turns=1):
    return biquad(signal, *coefficients("high", frequency, q), turns)


def band(signal, frequency, q=1.0, turns=1):
    return biquad(signal, *coefficients("band", frequency, q), turns)


def add(total, signal, at=0, gain=1.0, wraps=False):
    """Adds `signal` from sample `at` on; samples past the end are dropped or wrap around."""
    count = len(total)
    for k, value in enumerate(signal):
        if at + k >= count and not wraps:
            return
        total[(at + k) % count] += gain * value


def ring(modes, seconds):
    """Damped sines: (frequency, seconds to 1/e, level) each."""
    count = samples(seconds)
    total = [0.0] * count
    for frequency, time, level in modes:
        w, fall = 2 * math.pi * frequency / RATE, math.exp(-1 / (time * RATE))
        factor, last, now = 2 * fall * math.cos(w), 0.0, fall * math.sin(w) * level
        for k in range(count):
            total[k] += last
            last, now = now, factor * now - fall * fall * last
    return total


def grains(rng, seconds, count, frequencies, times, shape=lambda share: 1.0, q=2.0):
    """Short bursts of noise at random moments; `shape`: their level over the length, 0 to 1."""
    total = [0.0] * samples(seconds)
    for _ in range(count):
        share = rng.random()
        time = rng.uniform(*times)
        grain = decay(band(noise(rng, samples(4 * time)), rng.uniform(*frequencies), q), time, 0.0005)
        add(total, grain, int(share * len(total)), rng.uniform(0.4, 1.0) * shape(share))
    return total


def bubble(rng, frequencies, seconds):
    """A sine that rises a little and dies away."""
    start, count = rng.uniform(*frequencies), samples(seconds)
    phase, out = 0.0, []
    for k in range(count):
        share = k / count
        phase += 2 * math.pi * start * (1 + 0.35 * share) / RATE
        out.append(math.sin(phase) * math.exp(-5 * share) * min(1.0, k / 40))
    return out


def mixed(seconds, *parts):
    """Parts are (signal, level) or (signal, level, seconds at which it begins)."""
    total = [0.0] * samples(seconds)
    for signal, level, *start in parts:
        add(total, signal, samples(start[0]) if start else 0, level)
    return total


def without_offset(signal):
    mean = sum(signal) / len(signal)
    return [value - mean for value in signal]


def finished(signal, peak):
    """A single sound: no offset, silence at both ends, `peak` of full scale."""
    out = high(signal, 30)
    fade = min(samples(0.012), len(out) // 4)
    for k in range(fade):
        out[-1 - k] *= k / fade
    for k in range(8):
        out[k] *= k / 8
    return scaled(without_offset_kept_ends(out), peak)


def without_offset_kept_ends(signal):
    """Takes the mean away with a hump, so that the ends stay silent."""
    count = len(signal)
    mean = sum(signal) / count
    return [value - mean * 2 * math.sin(math.pi * k / count) ** 2 for k, value in enumerate(signal)]


def scaled(signal, peak):
    factor = peak / max(abs(value) for value in signal)
    return [value * factor for value in signal]


def write(path, signal):
    data = bytearray()
    for value in signal:
        data += max(-FULL, min(FULL, round(value * FULL))).to_bytes(2, "little", signed=True)
    path = pathlib.Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    with wave.open(str(path), "wb") as out:
        out.setnchannels(1)
        out.setsampwidth(2)
        out.setframerate(RATE)
        out.writeframes(bytes(data))


def generator_of(name):
    """A random generator per sound, so that a new sound changes no other."""
    return random.Random("terrane " + name)
