#include "terrane/render/preset_choice.h"

#include <cassert>

namespace terrane::render {

PresetChoice choosePreset(double lowMilliseconds) {
    assert(lowMilliseconds > 0 && "a frame takes time");
    PresetChoice choice{&presets().front(), 1000 / lowMilliseconds};
    double dearest = 1;
    for (const Preset& preset : presets()) {
        const double cost = preset.relativeCost.value_or(0), milliseconds = cost * lowMilliseconds;
        if (cost <= dearest || milliseconds > kTargetMilliseconds) continue;
        dearest = cost;
        choice = {&preset, 1000 / milliseconds};
    }
    return choice;
}

}  // namespace terrane::render
