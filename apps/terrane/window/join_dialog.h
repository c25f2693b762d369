// The title screen's page to join a server: known servers, and fields for another. Immediate mode.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/terrane/window/overlay.h"
#include "apps/terrane/window/remote_play.h"
#include "apps/terrane/window/server_list.h"
#include "apps/terrane/window/text.h"

namespace terrane::app {

class JoinDialog {
  public:
    explicit JoinDialog(std::filesystem::path listFile) : listFile_(std::move(listFile)) {}

    // Reads the list; the fields start with the last server.
    void open();

    enum class Outcome : std::uint8_t { None, Join, Back };
    Outcome draw(const Screen& screen, const Texts& tr);
    // The server and name to join, checked.
    const RemoteOptions& options() const { return options_; }

  private:
    void drawList(const Texts& tr);
    bool drawFields(const Texts& tr);
    bool check();
    void forget();

    std::filesystem::path listFile_;
    std::vector<PlayedServer> servers_;
    RemoteOptions options_;
    std::string problem_;  // error in the fields
};

}  // namespace terrane::app
