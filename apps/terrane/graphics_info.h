// Facts about the graphics driver for `terrane info`.
#pragma once

#include <nlohmann/json.hpp>

namespace terrane::app {

nlohmann::json graphicsInfo();  // {"error": …} without a driver

}  // namespace terrane::app
