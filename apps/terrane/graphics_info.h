// What `terrane info` says of the graphics driver.
#pragma once

#include <nlohmann/json.hpp>

namespace terrane::app {

nlohmann::json graphicsInfo();  // {"error": …} where there is none

}  // namespace terrane::app
