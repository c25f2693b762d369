#include "apps/terrane/commands/progress.h"

#include <memory>
#include <optional>
#include <utility>

#include "terrane/base/log.h"
#include "terrane/base/process.h"

namespace terrane::app {

io::Progress progressBar(std::string what) {
    struct Shown {
        base::StopSignals signals;
        std::optional<base::ProgressBar> bar;
    };
    return [what = std::move(what), shown = std::shared_ptr<Shown>()](std::size_t done,
                                                                      std::size_t total) mutable {
        if (!shown) {
            shown = std::make_shared<Shown>();
            shown->bar.emplace(what, total);
        }
        shown->bar->set(done);
        return !shown->signals.stopRequested();
    };
}

}  // namespace terrane::app
