#include "terrane/gpu/debug.h"

#include <epoxy/gl.h>

#include "terrane/gpu/buffer.h"
#include "tests/gpu/gl_fixture.h"

namespace terrane::gpu {
namespace {

class DebugTest : public GlTest {};

TEST_F(DebugTest, countsAnErrorOfTheDriver) {
    glEnable(GL_TEXTURE_1D_ARRAY);  // not a capability
    EXPECT_EQ(context().debugErrorCount(), 1);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_INVALID_ENUM));
    context().debugLog()->clear();
    EXPECT_EQ(context().debugErrorCount(), 0);
}

TEST_F(DebugTest, ignoresGroupsAndNotifications) {
    const DebugGroup group("outer");
    const DebugGroup inner(std::string(1000, 'x'));
    const std::string text = "a note";
    glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, GL_DEBUG_TYPE_OTHER, 1, GL_DEBUG_SEVERITY_NOTIFICATION,
                         -1, text.c_str());
    glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, GL_DEBUG_TYPE_PERFORMANCE, 2, GL_DEBUG_SEVERITY_LOW, -1,
                         text.c_str());
    EXPECT_EQ(context().debugErrorCount(), 0);
}

TEST_F(DebugTest, labelsObjectsAndCutsLongNames) {
    const std::string longName(1000, 'n');
    const Buffer buffer(16, 0, longName);
    char label[512] = {};
    GLsizei length = 0;
    glGetObjectLabel(GL_BUFFER, buffer.id(), sizeof label, &length, label);
    EXPECT_EQ(std::string(label), std::string(255, 'n'));
}

TEST_F(DebugTest, fatalLogStopsAtTheFirstError) {
    testing::FLAGS_gtest_death_test_style = "threadsafe";
    EXPECT_DEATH(DebugLog(true).addError("broken on purpose"), "broken on purpose");
}

}  // namespace
}  // namespace terrane::gpu
