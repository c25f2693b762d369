#include "apps/terrane/graphics_info.h"

namespace terrane::app {

nlohmann::json graphicsInfo() {
    return {{"error", "this program was built without graphics"}};
}

}  // namespace terrane::app
