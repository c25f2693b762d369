// Structs of terrane/shared lie in buffers as C++ has them in memory: offsets and sizes as a linked program
// reports them.

#include <cstddef>
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "terrane/base/files.h"
#include "terrane/gpu/program.h"
#include "terrane/shared/air.h"
#include "terrane/shared/culling.h"
#include "terrane/shared/drainage.h"
#include "terrane/shared/figure.h"
#include "terrane/shared/frame.h"
#include "terrane/shared/generation.h"
#include "terrane/shared/land.h"
#include "terrane/shared/light_solver.h"
#include "terrane/shared/mesh_section.h"
#include "terrane/shared/mesher.h"
#include "terrane/shared/packed_section.h"
#include "terrane/shared/quad.h"
#include "terrane/shared/quad_light.h"
#include "terrane/shared/ray_scene.h"
#include "terrane/shared/ray_step.h"
#include "terrane/shared/shadow.h"
#include "terrane/shared/shape_face.h"
#include "terrane/shared/tint.h"
#include "tests/gpu/gl_fixture.h"

namespace terrane::gpu {
namespace {

class SharedLayoutTest : public GlTest {};

struct Member {
    std::string name;
    std::size_t offset;
};
struct StructLayout {
    std::string name, header;
    bool isUniform;  // std140, else std430
    std::size_t sizeBytes;
    std::vector<Member> members;  // all
};

std::vector<StructLayout> frameLayouts() {
    using shared::Frame, shared::MaterialRecord;
    return {{"Frame",
             "frame.h",
             true,
             sizeof(Frame),
             {{"viewProjection", offsetof(Frame, viewProjection)},
              {"rayAhead", offsetof(Frame, rayAhead)},
              {"rayAcross", offsetof(Frame, rayAcross)},
              {"rayUp", offsetof(Frame, rayUp)},
              {"cameraPosition", offsetof(Frame, cameraPosition)},
              {"lightDirection", offsetof(Frame, lightDirection)},
              {"lightColor", offsetof(Frame, lightColor)},
              {"ambientColor", offsetof(Frame, ambientColor)},
              {"horizonColor", offsetof(Frame, horizonColor)},
              {"glowColor", offsetof(Frame, glowColor)},
              {"discColor", offsetof(Frame, discColor)},
              {"exposure", offsetof(Frame, exposure)},
              {"viewportSize", offsetof(Frame, viewportSize)},
              {"lightOnScreen", offsetof(Frame, lightOnScreen)},
              {"cameraChunk", offsetof(Frame, cameraChunk)},
              {"firstLightTile", offsetof(Frame, firstLightTile)},
              {"lightGridTiles", offsetof(Frame, lightGridTiles)},
              {"switches", offsetof(Frame, switches)},
              {"singleTransparencyLayer", offsetof(Frame, singleTransparencyLayer)},
              {"view", offsetof(Frame, view)},
              {"fogDistance", offsetof(Frame, fogDistance)},
              {"nearPlane", offsetof(Frame, nearPlane)},
              {"edgeExpansion", offsetof(Frame, edgeExpansion)},
              {"timeSeconds", offsetof(Frame, timeSeconds)},
              {"waterAbove", offsetof(Frame, waterAbove)},
              {"ambientFromBelow", offsetof(Frame, ambientFromBelow)},
              {"hiddenLampShare", offsetof(Frame, hiddenLampShare)},
              {"discSine", offsetof(Frame, discSine)},
              {"starBrightness", offsetof(Frame, starBrightness)},
              {"starTurn", offsetof(Frame, starTurn)},
              {"lightRayShare", offsetof(Frame, lightRayShare)},
              {"isMoon", offsetof(Frame, isMoon)},
              {"bottom", offsetof(Frame, bottom)},
              {"top", offsetof(Frame, top)},
              {"unused0", offsetof(Frame, unused0)},
              {"unused1", offsetof(Frame, unused1)}}},
            {"MaterialRecord",
             "frame.h",
             false,
             sizeof(MaterialRecord),
             {{"look", offsetof(MaterialRecord, look)},
              {"options", offsetof(MaterialRecord, options)},
              {"meanColor", offsetof(MaterialRecord, meanColor)},
              {"unused", offsetof(MaterialRecord, unused)}}}};
}

std::vector<StructLayout> meshSectionLayouts() {
    using shared::MeshSectionRecord, shared::DrawCommand, shared::DrawRecord, shared::DrawCounts,
        shared::CullFrame, shared::TestedMeshSections;
    return {{"MeshSectionRecord",
             "mesh_section.h",
             false,
             sizeof(MeshSectionRecord),
             {{"chunk", offsetof(MeshSectionRecord, chunk)},
              {"place", offsetof(MeshSectionRecord, place)},
              {"heights", offsetof(MeshSectionRecord, heights)},
              {"ranges", offsetof(MeshSectionRecord, ranges)}}},
            {"DrawCommand",
             "mesh_section.h",
             false,
             sizeof(DrawCommand),
             {{"indexCount", offsetof(DrawCommand, indexCount)},
              {"instanceCount", offsetof(DrawCommand, instanceCount)},
              {"firstIndex", offsetof(DrawCommand, firstIndex)},
              {"baseVertex", offsetof(DrawCommand, baseVertex)},
              {"baseInstance", offsetof(DrawCommand, baseInstance)}}},
            {"DrawRecord",
             "mesh_section.h",
             false,
             sizeof(DrawRecord),
             {{"chunk", offsetof(DrawRecord, chunk)},
              {"place", offsetof(DrawRecord, place)},
              {"firstQuad", offsetof(DrawRecord, firstQuad)}}},
            {"DrawCounts",
             "mesh_section.h",
             false,
             sizeof(DrawCounts),
             {{"commands", offsetof(DrawCounts, commands)},
              {"quads", offsetof(DrawCounts, quads)},
              {"meshSections", offsetof(DrawCounts, meshSections)}}},
            {"TestedMeshSections",
             "mesh_section.h",
             false,
             sizeof(TestedMeshSections),
             {{"groups", offsetof(TestedMeshSections, groups)},
              {"one1", offsetof(TestedMeshSections, one1)},
              {"one2", offsetof(TestedMeshSections, one2)},
              {"count", offsetof(TestedMeshSections, count)}}},
            {"CullFrame",
             "mesh_section.h",
             true,
             sizeof(CullFrame),
             {{"cameraPlanes", offsetof(CullFrame, cameraPlanes)},
              {"cameraPosition", offsetof(CullFrame, cameraPosition)},
              {"firstCommand", offsetof(CullFrame, firstCommand)},
              {"view.viewProjection", offsetof(CullFrame, view.viewProjection)},
              {"view.viewportSize", offsetof(CullFrame, view.viewportSize)},
              {"view.nearPlane", offsetof(CullFrame, view.nearPlane)},
              {"view.edgeExpansion", offsetof(CullFrame, view.edgeExpansion)},
              {"view.blockPixels", offsetof(CullFrame, view.blockPixels)},
              {"view.samples", offsetof(CullFrame, view.samples)},
              {"view.hiZLevels", offsetof(CullFrame, view.hiZLevels)},
              {"view.hidesBacks", offsetof(CullFrame, view.hidesBacks)},
              {"cameraChunk", offsetof(CullFrame, cameraChunk)},
              {"meshSectionCount", offsetof(CullFrame, meshSectionCount)},
              {"phase", offsetof(CullFrame, phase)},
              {"arenaQuads", offsetof(CullFrame, arenaQuads)},
              {"commandsEnd", offsetof(CullFrame, commandsEnd)},
              {"maxTestGroups", offsetof(CullFrame, maxTestGroups)},
              {"unused", offsetof(CullFrame, unused)}}}};
}

std::vector<StructLayout> cullingLayouts() {
    using shared::CullView, shared::Footprint, shared::HiZArea;
    return {{"CullView",
             "mesh_section.h",
             true,
             sizeof(CullView),
             {{"viewProjection", offsetof(CullView, viewProjection)},
              {"viewportSize", offsetof(CullView, viewportSize)},
              {"nearPlane", offsetof(CullView, nearPlane)},
              {"edgeExpansion", offsetof(CullView, edgeExpansion)},
              {"blockPixels", offsetof(CullView, blockPixels)},
              {"samples", offsetof(CullView, samples)},
              {"hiZLevels", offsetof(CullView, hiZLevels)},
              {"hidesBacks", offsetof(CullView, hidesBacks)}}},
            {"Footprint",
             "culling.h",
             false,
             sizeof(Footprint),
             {{"low", offsetof(Footprint, low)},
              {"high", offsetof(Footprint, high)},
              {"nearest", offsetof(Footprint, nearest)},
              {"isBefore", offsetof(Footprint, isBefore)},
              {"isBack", offsetof(Footprint, isBack)},
              {"unused", offsetof(Footprint, unused)}}},
            {"HiZArea",
             "culling.h",
             false,
             sizeof(HiZArea),
             {{"first", offsetof(HiZArea, first)},
              {"last", offsetof(HiZArea, last)},
              {"level", offsetof(HiZArea, level)},
              {"unused", offsetof(HiZArea, unused)}}}};
}

std::vector<StructLayout> mesherLayouts() {
    using shared::MeshUnit, shared::MeshType, shared::MeshSectionCounts;
    return {{"MeshUnit",
             "mesher.h",
             false,
             sizeof(MeshUnit),
             {{"section", offsetof(MeshUnit, section)},
              {"blockState", offsetof(MeshUnit, blockState)},
              {"meshSection", offsetof(MeshUnit, meshSection)},
              {"layers", offsetof(MeshUnit, layers)},
              {"neighbors", offsetof(MeshUnit, neighbors)},
              {"neighborStates", offsetof(MeshUnit, neighborStates)},
              {"baseZ", offsetof(MeshUnit, baseZ)},
              {"unused", offsetof(MeshUnit, unused)}}},
            {"MeshType",
             "mesher.h",
             false,
             sizeof(MeshType),
             {{"flags", offsetof(MeshType, flags)},
              {"forms", offsetof(MeshType, forms)},
              {"faces", offsetof(MeshType, faces)}}},
            {"MeshSectionCounts",
             "mesher.h",
             false,
             sizeof(MeshSectionCounts),
             {{"quads", offsetof(MeshSectionCounts, quads)},
              {"minZ", offsetof(MeshSectionCounts, minZ)},
              {"maxZ", offsetof(MeshSectionCounts, maxZ)}}}};
}

std::vector<StructLayout> otherLayouts() {
    using shared::FigureRecord, shared::Quad, shared::ShapeFace, shared::TileJob, shared::PackedSection,
        shared::SolverRound;
    return {{"Quad",
             "quad.h",
             false,
             sizeof(Quad),
             {{"word0", offsetof(Quad, word0)}, {"word1", offsetof(Quad, word1)}}},
            {"QuadLight",
             "quad_light.h",
             false,
             sizeof(shared::QuadLight),
             {{"corners01", offsetof(shared::QuadLight, corners01)},
              {"corners23", offsetof(shared::QuadLight, corners23)}}},
            {"ShapeFace",
             "shape_face.h",
             false,
             sizeof(ShapeFace),
             {{"base", offsetof(ShapeFace, base)},
              {"axisU", offsetof(ShapeFace, axisU)},
              {"axisV", offsetof(ShapeFace, axisV)},
              {"bend", offsetof(ShapeFace, bend)}}},
            {"FigureRecord",
             "figure.h",
             true,
             sizeof(FigureRecord),
             {{"feet", offsetof(FigureRecord, feet)},
              {"pose", offsetof(FigureRecord, pose)},
              {"swing", offsetof(FigureRecord, swing)},
              {"look", offsetof(FigureRecord, look)},
              {"unused0", offsetof(FigureRecord, unused0)},
              {"unused1", offsetof(FigureRecord, unused1)}}},
            {"TileJob",
             "generation.h",
             false,
             sizeof(TileJob),
             {{"origin", offsetof(TileJob, origin)},
              {"fieldSlots", offsetof(TileJob, fieldSlots)},
              {"blockSlots", offsetof(TileJob, blockSlots)}}},
            {"PackedSection",
             "packed_section.h",
             false,
             sizeof(PackedSection),
             {{"bits", offsetof(PackedSection, bits)},
              {"palette", offsetof(PackedSection, palette)},
              {"words", offsetof(PackedSection, words)},
              {"unused", offsetof(PackedSection, unused)}}},
            {"SolverRound",
             "light_solver.h",
             false,
             sizeof(SolverRound),
             {{"groupsX", offsetof(SolverRound, groupsX)},
              {"groupsY", offsetof(SolverRound, groupsY)},
              {"groupsZ", offsetof(SolverRound, groupsZ)},
              {"unused", offsetof(SolverRound, unused)}}}};
}

std::vector<StructLayout> landLayouts() {
    using shared::AirFrame, shared::DrainageList, shared::LandFrame, shared::RiverSegment, shared::ShadowDraw,
        shared::ShadowFrame, shared::TintFrame;
    return {{"AirFrame",
             "air.h",
             true,
             sizeof(AirFrame),
             {{"lightAzimuth", offsetof(AirFrame, lightAzimuth)},
              {"aureole", offsetof(AirFrame, aureole)},
              {"depth", offsetof(AirFrame, depth)},
              {"levels", offsetof(AirFrame, levels)}}},
            {"LandFrame",
             "land.h",
             true,
             sizeof(LandFrame),
             {{"levels[0]", offsetof(LandFrame, levels)}, {"heights", offsetof(LandFrame, heights)}}},
            {"RiverSegment",
             "drainage.h",
             false,
             sizeof(RiverSegment),
             {{"line", offsetof(RiverSegment, line)},
              {"course", offsetof(RiverSegment, course)},
              {"flow", offsetof(RiverSegment, flow)}}},
            {"DrainageList",
             "drainage.h",
             false,
             sizeof(DrainageList),
             {{"first", offsetof(DrainageList, first)},
              {"segmentCount", offsetof(DrainageList, segmentCount)},
              {"lakeCount", offsetof(DrainageList, lakeCount)},
              {"unused", offsetof(DrainageList, unused)}}},
            {"TintFrame", "tint.h", true, sizeof(TintFrame), {{"levels[0]", offsetof(TintFrame, levels)}}},
            {"ShadowFrame",
             "shadow.h",
             true,
             sizeof(ShadowFrame),
             {{"toMap[0]", offsetof(ShadowFrame, toMap)},
              {"reach", offsetof(ShadowFrame, reach)},
              {"layers", offsetof(ShadowFrame, layers)},
              {"texels", offsetof(ShadowFrame, texels)},
              {"strength", offsetof(ShadowFrame, strength)},
              {"mapTexels", offsetof(ShadowFrame, mapTexels)},
              {"unused0", offsetof(ShadowFrame, unused0)},
              {"unused1", offsetof(ShadowFrame, unused1)}}},
            {"ShadowDraw",
             "shadow.h",
             true,
             sizeof(ShadowDraw),
             {{"toClip", offsetof(ShadowDraw, toClip)},
              {"toLight", offsetof(ShadowDraw, toLight)},
              {"anchorChunk", offsetof(ShadowDraw, anchorChunk)},
              {"unused", offsetof(ShadowDraw, unused)}}}};
}

std::vector<StructLayout> rayLayouts() {
    using shared::Ray, shared::RayColumn, shared::RayHit, shared::RayPlace;
    return {{"Ray",
             "ray_step.h",
             false,
             sizeof(Ray),
             {{"cell", offsetof(Ray, cell)},
              {"mirror", offsetof(Ray, mirror)},
              {"start", offsetof(Ray, start)},
              {"direction", offsetof(Ray, direction)},
              {"inverse", offsetof(Ray, inverse)}}},
            {"RayPlace",
             "ray_step.h",
             false,
             sizeof(RayPlace),
             {{"cell", offsetof(RayPlace, cell)},
              {"t", offsetof(RayPlace, t)},
              {"axis", offsetof(RayPlace, axis)},
              {"level", offsetof(RayPlace, level)},
              {"unused", offsetof(RayPlace, unused)}}},
            {"RayHit",
             "ray_step.h",
             false,
             sizeof(RayHit),
             {{"cell", offsetof(RayHit, cell)},
              {"face", offsetof(RayHit, face)},
              {"t", offsetof(RayHit, t)},
              {"level", offsetof(RayHit, level)},
              {"unused", offsetof(RayHit, unused)}}},
            {"RayColumn",
             "ray_scene.h",
             false,
             sizeof(RayColumn),
             {{"state", offsetof(RayColumn, state)},
              {"level", offsetof(RayColumn, level)},
              {"words", offsetof(RayColumn, words)},
              {"heights", offsetof(RayColumn, heights)},
              {"end", offsetof(RayColumn, end)}}}};
}

std::vector<StructLayout> allLayouts() {
    std::vector<StructLayout> all;
    for (const auto& layouts : {frameLayouts(), meshSectionLayouts(), cullingLayouts(), mesherLayouts(),
                                otherLayouts(), landLayouts(), rayLayouts()}) {
        all.insert(all.end(), layouts.begin(), layouts.end());
    }
    return all;
}

// Shader with two of the struct in a block, and a word after them whose offset gives their size.
std::string shaderWith(const StructLayout& layout) {
    const std::string block = layout.isUniform ? "layout(binding = 0, std140) uniform"
                                               : "layout(binding = 0, std430) readonly buffer";
    return "#include \"terrane/shared/" + layout.header + "\"\nlayout(local_size_x = 1) in;\n" + block +
           " Items { " + layout.name + " items[2]; uint behind; };\n" +
           "layout(binding = 1, std430) writeonly buffer Copy { " + layout.name + " copy; };\n" +
           "void main() { copy = items[behind & 1u]; }\n";
}

GLint offsetOf(const Program& program, GLenum interface, const std::string& name) {
    const GLuint index = glGetProgramResourceIndex(program.id(), interface, name.c_str());
    if (index == GL_INVALID_INDEX) return -1;
    const GLenum property = GL_OFFSET;
    GLint offset = -1;
    glGetProgramResourceiv(program.id(), interface, index, 1, &property, 1, nullptr, &offset);
    return offset;
}

std::size_t countNames(const Program& program, GLenum interface, const std::string& beginning) {
    GLint resources = 0;
    glGetProgramInterfaceiv(program.id(), interface, GL_ACTIVE_RESOURCES, &resources);
    std::size_t count = 0;
    for (GLint k = 0; k < resources; ++k) {
        char name[128] = {};
        glGetProgramResourceName(program.id(), interface, static_cast<GLuint>(k), sizeof(name), nullptr,
                                 name);
        count += std::string(name).starts_with(beginning) ? 1 : 0;
    }
    return count;
}

TEST_F(SharedLayoutTest, structsLieInBuffersAsInMemory) {
    for (const StructLayout& layout : allLayouts()) {
        const std::string text = shaderWith(layout);
        const base::EmbeddedFile file = {"layout.comp.glsl", text};
        const ShaderLoader loader(std::span(&file, 1), TERRANE_SOURCE_DIR);
        const base::Result<Program> program = Program::compute(loader, file.path, {}, "layout");
        ASSERT_TRUE(program) << layout.name << ": " << program.error().message;
        const GLenum interface = layout.isUniform ? GL_UNIFORM : GL_BUFFER_VARIABLE;
        for (const Member& member : layout.members) {
            EXPECT_EQ(offsetOf(*program, interface, "items[0]." + member.name),
                      static_cast<GLint>(member.offset))
                << layout.name << "::" << member.name;
        }
        EXPECT_EQ(countNames(*program, interface, "items[0]."), layout.members.size()) << layout.name;
        EXPECT_EQ(offsetOf(*program, interface, "behind"), static_cast<GLint>(2 * layout.sizeBytes))
            << layout.name;
    }
}

// Every struct in terrane/shared must be in the lists above.
TEST(SharedStructs, everyOneIsChecked) {
    std::set<std::string> known, found;
    for (const StructLayout& layout : allLayouts()) known.insert(layout.name);
    const std::filesystem::path folder = std::filesystem::path(TERRANE_SOURCE_DIR) / "terrane/shared";
    const std::regex declaration("\nstruct (\\w+) \\{");
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const base::Result<std::string> text = base::readFile(entry.path());
        ASSERT_TRUE(text) << text.error().message;
        const std::string shared = text->substr(0, text->rfind("\nSHARED_END\n"));  // behind it: C++ alone
        for (std::sregex_iterator at(shared.begin(), shared.end(), declaration), end; at != end; ++at) {
            found.insert((*at)[1]);
        }
    }
    EXPECT_EQ(found, known);
}

}  // namespace
}  // namespace terrane::gpu
