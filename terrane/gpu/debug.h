// The driver's debug messages: logged, and its errors counted. A context made with the debug option owns the
// log; tests fail when it counted an error. Messages come inside the call at fault, so on the context's
// thread and no other.
#pragma once

#include <memory>
#include <string_view>

namespace terrane::gpu {

class DebugLog {
  public:
    explicit DebugLog(bool fatal) : fatal_(fatal) {}

    [[nodiscard]] int errorCount() const { return errors_; }
    void clear() { errors_ = 0; }

    // Counts and logs an error of the driver; aborts the program afterwards if the log is fatal.
    void addError(std::string_view message) const;

  private:
    mutable int errors_ = 0;  // counted through the const pointer that OpenGL hands back
    bool fatal_ = false;
};

// Sends the current context's messages to the returned log, which must outlive the context. Errors, undefined
// behavior and messages of high severity are counted; other messages are only logged, notifications dropped.
// Messages of the shader compiler are left to Program, which returns them.
[[nodiscard]] std::unique_ptr<DebugLog> enableDebugOutput(bool fatal);

// Groups the GL calls made during its life under a name in debuggers and driver messages.
class DebugGroup {
  public:
    explicit DebugGroup(std::string_view name);
    ~DebugGroup();
    DebugGroup(const DebugGroup&) = delete;
    DebugGroup& operator=(const DebugGroup&) = delete;
};

}  // namespace terrane::gpu
