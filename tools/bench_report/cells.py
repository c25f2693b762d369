"""Command lines of the program. They identify measurements. apps/terrane/bench/bench_plan.cpp runs the same ones;
tests/app/bench_test.py compares the two."""

from dataclasses import dataclass

from .results import BadInput

SCENES = ("ocean", "desert", "landscape", "cave")
MEMORY_COPY = "bench --memory-copy"  # how fast one thread copies memory


@dataclass(frozen=True)
class Settings:
    """The settings of the run that command lines depend on."""
    is_quick: bool
    size: str
    view_distance: int
    farthest: int          # largest view distance of tables with several
    frames: int            # per run
    most_samples: int      # of the graphics driver
    is_software: bool      # the CPU draws
    flight_seconds: float


def settings_of(results):
    """Files of older programs lack some settings."""
    about = results.about
    try:
        is_quick, view_distance = bool(about["quick"]), int(about["view_distance"])
        is_software = about.get("software_renderer", "llvmpipe" in str(about.get("renderer")))
        farthest = 64 if view_distance == 32 and not is_quick else view_distance  # as older programs had it
        return Settings(is_quick, str(about["picture"]), view_distance,
                        int(about.get("farthest_view_distance", farthest)),
                        int(about["frames_of_a_run"]), int(about.get("most_samples", 4 if is_software else 8)),
                        bool(is_software), float(about.get("seconds_of_a_flight", 4 if is_quick else 20)))
    except (KeyError, TypeError, ValueError) as error:
        raise BadInput(f"results without the settings of terrane bench: {error}") from error


def command_line(command, **flags):
    """`_` in a flag's name stands for `-`."""
    return " ".join([command, *(f"--{flag.replace('_', '-')} {word}" for flag, word in flags.items())])


def frame(s, scene, **flags):
    """Frames of a scene with the options of the thesis, changed by `flags`."""
    return command_line("render", **{
        "scene": scene, "preset": "thesis", "view_distance": s.view_distance, "size": s.size, "frames": s.frames,
        "samples": 2, "shading": "sample", "shadows": "near",
        "shadow_size": 1024 if s.is_quick else 2048, "layers": 3,
        "merging": "squares-ext", "mesh_section_height": 64, **flags})


def plain_frame(s, **flags):
    """Frames of the landscape with `--preset low`."""
    return command_line("render", **{"scene": "landscape", "preset": "low", "view_distance": s.view_distance,
                                     "size": s.size, "frames": s.frames, **flags})


def merging(s, scene, method):
    """Frames with a merging method, without occlusion culling."""
    return frame(s, scene, merging=method, occlusion_culling="off")


def generating(scene, view_distance, **flags):
    """Generates all chunks in view of a scene and draws a small image."""
    return command_line("render", scene=scene, preset="low", view_distance=view_distance, size="320x180", **flags)


def loading(scene, view_distance):
    """The same from a complete save."""
    return generating(scene, view_distance, world=f"{scene}-{view_distance}")


def flight(s, is_from_save):
    """A straight flight over the landscape."""
    return command_line("flight-bench", scene="landscape", duration=f"{s.flight_seconds:g}",
                        preset="low" if s.is_software else "thesis", view_distance=s.view_distance,
                        size="320x180" if s.is_software else s.size,
                        **({"world": "flight"} if is_from_save else {}))


def generate_one_thread(s):
    return command_line("generate", generator="overworld", radius=6 if s.is_quick else 16, threads=1, backend="cpu")


def view_distances(s):
    """View distances up to the one of the settings."""
    return [*(distance for distance in (4, 8, 16, 32, 64) if distance < s.view_distance), s.view_distance]


def pixels(size):
    width, height = size.split("x")
    return int(width) * int(height)
