#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <numbers>
#include <string_view>
#include <utility>

#include "cases/case_reader.h"
#include "tests/cli/program.h"
#include "tests/temporary_folder.h"

namespace rastercheck::cli::import_test {
namespace {

std::string square_mesh() {
  std::string file = testing::TempDir() + "import_test_square.obj";
  std::ofstream(file) << "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n";
  return file;
}

/// A file that claims to have more vertices than any memory can hold.
constexpr const char* kHugePly =
    "ply\nformat ascii 1.0\nelement vertex 4294967295\nproperty float x\nproperty float y\n"
    "property float z\nend_header\n0 0 0\n";

TEST(Import, PrintsACaseThatTheOracleReads) {
  const Outcome imported =
      run_program({"import", square_mesh(), "--width", "16", "--height", "8", "--rules", "opengl"});
  ASSERT_EQ(imported.code, 0) << imported.err;
  const auto c = cases::parse_case(imported.out, "-");
  ASSERT_TRUE(c) << to_string(c.error());
  EXPECT_EQ(c->framebuffer, (cases::FramebufferSize{16, 8, 1}));
  EXPECT_EQ(c->rules, cases::Rules::opengl);
  EXPECT_EQ(c->triangles.size(), 2U);
  const Outcome oracle = run_program({"oracle", "-", "--json"}, imported.out);
  EXPECT_EQ(oracle.code, 0) << oracle.err;
  EXPECT_NE(oracle.out.find("required"), std::string::npos);
}

// Kills: overwriting the mesh with the case made from it.
TEST(Import, WritesACaseButNotOverTheMesh) {
  const TemporaryFolder folder;
  const std::string mesh = folder.put("square.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nf 1 2 3\n");
  const Outcome imported = run_program({"import", mesh, "--output", folder.path("square.json")});
  ASSERT_EQ(imported.code, 0) << imported;
  EXPECT_EQ(imported.out, "");
  EXPECT_EQ(cases::read_case(folder.path("square.json"))->triangles.size(), 1U);
  const Outcome refused = run_program({"import", mesh, "--output", folder.path("./square.obj")});
  EXPECT_TRUE(is_failure(refused, 2)) << refused;
  EXPECT_NE(refused.err.find("is the input and would be overwritten"), std::string::npos);
  EXPECT_TRUE(folder.content("square.obj").starts_with("v -1"));
}

TEST(Import, ReadsStandardInputInTheFormatGiven) {
  const Outcome imported = run_program({"import", "-", "--format", "off", "--quiet"},
                                       "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  ASSERT_EQ(imported.code, 0) << imported.err;
  EXPECT_EQ(cases::parse_case(imported.out, "-")->triangles.size(), 1U);
}

TEST(Import, NamesAFileThatIsNotThere) {
  EXPECT_EQ(run_program({"import", "no/such.obj"}).err,
            "rastercheck: no/such.obj: cannot be read: No such file or directory\n");
}

TEST(Import, RefusesWhatIsNoMesh) {
  const Outcome outcome = run_program({"import", source_file("README.md")});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1);
}

// Kills: passing on assimp's message, which names a file that does not exist.
TEST(Import, SaysWhatIsWrongWithTheFormatOfStandardInput) {
  const auto reason = [](const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"import", "-"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = run_program(arguments, "neither\n");
    EXPECT_TRUE(is_failure(outcome, 2)) << outcome;
    return outcome.err;
  };
  EXPECT_EQ(run_program({"import", "-", "--format", "obj"}, "").err,
            "rastercheck: -: not a mesh: empty\n");
  EXPECT_EQ(
      reason({}),
      "rastercheck: -: not a mesh, or of a format that must be named, such as --format obj\n");
  EXPECT_EQ(reason({"--format", "frobnicate"}),
            "rastercheck: -: unknown mesh format 'frobnicate'\n");
  EXPECT_EQ(reason({"--format", "glb"}), "rastercheck: -: not a mesh of the format 'glb'\n");
  EXPECT_EQ(reason({"--format", "3ds"}),
            "rastercheck: -: not a mesh: 3DS file is either empty or corrupt: -.3ds\n");
}

// Kills: reading the file in the program itself. These files crash assimp 5.2.5; later versions may
// refuse or read them.
TEST(Import, AFileThatCrashesTheMeshReaderIsRefusedInOneLine) {
  const bool crashes = std::string_view(RASTERCHECK_ASSIMP_VERSION).starts_with("5.2.");
  for (const char* off :
       {"OFF\n3 1 0\n0 0 0\n2  4 03 \n 11 20 0\n0 4 03 \n 11 2\n",
        "OFF\n3 11 0\n0 0 0\n2 0 0\n0 4 1\n3 0 1  0\n0 0 0\n2 0 0\n0 4 1\n3 0 1 2\n"}) {
    const Outcome outcome = run_program({"import", "-", "--format", "off"}, off);
    if (!crashes && outcome.code == 0) continue;
    EXPECT_TRUE(is_failure(outcome, 2)) << outcome;
    EXPECT_EQ(outcome.err.starts_with("rastercheck: -: the mesh reader "), crashes) << outcome;
  }
}

TEST(Import, AFileThatNeedsTooMuchMemoryIsRefusedInOneLine) {
  const Outcome outcome = run_program({"import", "-", "--format", "ply"}, kHugePly);
  EXPECT_TRUE(is_failure(outcome, 2)) << outcome;
}

// Kills: guesses that nobody is told, a captured draw read as a mesh.
TEST(Import, ReadsADrawThatRenderDocExported) {
  const TemporaryFolder folder;
  const std::string draw = folder.put("draw.csv",
                                      "VTX, IDX, gl_Position.x, gl_Position.y, uv.x\n"
                                      "0, 0, -1.00, -1.00, 0.1\n1, 1, 3.00, -1.00, 0\n"
                                      "2, 2, -1.00, 3.00, 1\n");
  const Outcome imported = run_program({"import", draw, "--width", "8", "--height", "4"});
  ASSERT_EQ(imported.code, 0) << imported;
  EXPECT_EQ(imported.err, "rastercheck: " + draw +
                              ": rules of vulkan (--rules)\nrastercheck: " + draw +
                              ": a list of triangles, because 3 vertices are a multiple of three "
                              "(--topology)\n");
  const auto c = cases::parse_case(imported.out, "-");
  ASSERT_TRUE(c) << to_string(c.error());
  EXPECT_EQ(c->framebuffer, (cases::FramebufferSize{8, 4, 1}));
  const Outcome held = run_program({"replay", "-", "--backend", "cpu", "-q"}, imported.out);
  EXPECT_EQ(held.code, 0) << held;
  // Standard input, all said.
  const Outcome quiet =
      run_program({"import",    "-",          "--format", "renderdoc-csv", "--rules",
                   "d3d",       "--topology", "strip",    "--viewport",    "1,0,6.5,-4",
                   "--samples", "4",          "--cull",   "back",          "--front-face",
                   "cw",        "--flat",     "uv",       "--width",       "8",
                   "--height",  "4"},
                  folder.content("draw.csv"));
  EXPECT_EQ(quiet.code, 0) << quiet;
  EXPECT_EQ(quiet.err, "");
  const auto said = cases::parse_case(quiet.out, "-");
  ASSERT_TRUE(said) << to_string(said.error());
  EXPECT_EQ(said->viewport, (cases::Viewport{1, 0, 6.5F, -4, 0, 1}));
  EXPECT_EQ(said->attributes[0].interpolation, cases::Interpolation::flat);
}

/// The numbers of each corner of each triangle: position, attributes, clip distances.
std::vector<std::vector<float>> corners(const cases::Case& c) {
  std::vector<std::vector<float>> all;
  for (const cases::Triangle& triangle : c.triangles) {
    for (const std::uint32_t i : triangle) {
      const cases::ClipVertex& p = c.positions[i];
      std::vector<float> numbers{p.x, p.y, p.z, p.w};
      const auto attributes = c.attributes_of(i);
      const auto distances = c.clip_distances_of(i);
      numbers.insert(numbers.end(), attributes.begin(), attributes.end());
      numbers.insert(numbers.end(), distances.begin(), distances.end());
      all.push_back(std::move(numbers));
    }
  }
  return all;
}

/// Exports a case of `rules` for piglit, and imports what was written.
std::pair<cases::Case, cases::Case> exported_and_imported(const std::string& rules) {
  const TemporaryFolder folder;
  const std::string file = folder.put(
      "a.json", R"({"format": "rastercheck-case", "version": 1, "rules": ")" + rules + R"(",
          "framebuffer": {"width": 8, "height": 6, "samples": 4},
          "viewport": {"x": 1, "y": 0.5, "width": 6.5, "height": 5}, "depth_clamp": true,
          "attributes": [{"name": "value0", "interpolation": "flat"},
            {"name": "value1", "interpolation": "noperspective", "location": "centroid"},
            {"name": "value2", "location": "center"}, {"name": "value3"}, {"name": "value4"}],
          "vertices": [
            {"position": [-1, -1, 0.25, 1], "attributes": [1, 2, "0x1.99999ap-4", 4, 5],
             "clip_distances": [1, -0.5]},
            {"position": [3, -1, 2, 1.5], "attributes": [6, 7, 8, 9, 10],
             "clip_distances": [1, 1]},
            {"position": [-1, 3, 0.5, 1], "attributes": [11, 12, 13, -14, 15],
             "clip_distances": [0.5, 1]},
            {"position": [1, 1, 1, 1], "attributes": [16, 17, 18, 19, 20],
             "clip_distances": [0.5, 1]}],
          "triangles": [[0, 1, 2], [2, 1, 3]],
          "found": {"property": "coverage-obeys-the-contract", "backend": "gl:llvmpipe",
                    "verdict": "missing", "seed": 1, "index": 1}})");
  const std::string test = folder.path("a.shader_test");
  const Outcome out = run_program({"export", file, "--format", "shader_test", "--output", test});
  if (out.code == 4) return {};  // the driver cannot run here
  EXPECT_EQ(out.code, 0) << out;
  const Outcome in = run_program({"import", test, "--quiet"});
  EXPECT_EQ(in.code, 0) << in;
  const auto again = cases::parse_case(in.out, "-");
  EXPECT_TRUE(again) << to_string(again.error());
  return {*cases::read_case(file), again.value_or(cases::Case())};
}

// Kills: an exporter and an importer that mean different things by the same test.
TEST(Import, ReadsWhatWasExportedForPiglit) {
  const auto [given, again] = exported_and_imported("opengl");
  if (given.positions.empty()) GTEST_SKIP() << "no llvmpipe";
  EXPECT_EQ(corners(again), corners(given));
  EXPECT_EQ(again.attributes, given.attributes);
  EXPECT_EQ(again.framebuffer, given.framebuffer);
  EXPECT_EQ(again.viewport, given.viewport);
  EXPECT_EQ(again.rules, given.rules);
  EXPECT_EQ(again.fill_rule, given.fill_rule);
  EXPECT_EQ(again.depth_clamp, given.depth_clamp);
  EXPECT_EQ(again.clip_distance_count, given.clip_distance_count);
}

// Of Vulkan's rules z is 2 z - w in OpenGL, and the first vertex comes last.
TEST(Import, ReadsWhatWasExportedOfVulkansRules) {
  const auto [given, again] = exported_and_imported("vulkan");
  if (given.positions.empty()) GTEST_SKIP() << "no llvmpipe";
  std::vector<std::vector<float>> expected = corners(given);
  for (std::size_t i = 0; i < expected.size(); i += 3) {
    const auto first = expected.begin() + static_cast<std::ptrdiff_t>(i);
    std::rotate(first, first + 1, first + 3);
  }
  for (std::vector<float>& numbers : expected) numbers[2] = 2 * numbers[2] - numbers[3];
  EXPECT_EQ(corners(again), expected);
  EXPECT_EQ(again.rules, cases::Rules::opengl);
  EXPECT_EQ(again.attributes, given.attributes);
}

// Kills: a message that leaves the user to guess what to write.
TEST(Import, RoundsTheDecimalsOfACase) {
  const TemporaryFolder folder;
  const std::string decimals = folder.put(
      "a.json",
      R"({"format": "rastercheck-case", "version": 1, "framebuffer": {"width": 8, "height": 4},
          "viewport": {"x": 0, "y": 0, "width": 8, "height": 4}, "rules": "vulkan",
          "vertices": [{"position": [0.1, 0, 0, 1]}, {"position": [1, 0, 0, 1]},
                       {"position": [0, 1, 0, 1]}], "triangles": [[0, 1, 2]]})");
  const Outcome refused = run_program({"import", decimals});
  EXPECT_TRUE(is_failure(refused, 2)) << refused;
  EXPECT_NE(refused.err.find("the nearest is \"0x1.99999ap-4\""), std::string::npos) << refused;
  const Outcome rounded = run_program({"import", decimals, "--round"});
  EXPECT_EQ(rounded.code, 0) << rounded;
  EXPECT_EQ(rounded.err,
            "rastercheck: " + decimals + ": 1 number rounded to the nearest float32\n");
  EXPECT_TRUE(cases::parse_case(rounded.out, "-"));
}

TEST(Import, RefusesOptionsThatDoNotApply) {
  const Outcome outcome = run_program({"import", square_mesh(), "--topology", "strip"});
  EXPECT_TRUE(is_failure(outcome, 2)) << outcome;
  EXPECT_NE(outcome.err.find("is a mesh, whose case takes no options but"), std::string::npos);
  const TemporaryFolder folder;
  const std::string draw = folder.put("draw.csv",
                                      "VTX, IDX, gl_Position.x, gl_Position.y\n0, 0, 0, 0\n"
                                      "1, 1, 1, 0\n2, 2, 0, 1\n");
  EXPECT_EQ(run_program({"import", draw, "--viewport", "1,2,3,4"}).code, 0);
  for (const char* viewport :
       {"1,2,3", "1,2,3,4,5", "a,b,c,d", "1,2,inf,4", "nan,2,3,4", "1,2,99999,4"}) {
    const Outcome wrong = run_program({"import", draw, "--viewport", viewport});
    EXPECT_TRUE(is_failure(wrong, 2)) << viewport;
    EXPECT_TRUE(wrong.err.starts_with("rastercheck: --viewport: ")) << wrong;
  }
  const Outcome no_mesh = run_program({"import", draw, "--fov", "60"});
  EXPECT_TRUE(is_failure(no_mesh, 2)) << no_mesh;
  EXPECT_NE(no_mesh.err.find("is no mesh, so it takes no --eye"), std::string::npos);
}

/// The error for a square mesh with these options.
std::string refusal(const std::vector<std::string>& options) {
  std::vector<std::string> arguments{"import", square_mesh()};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const Outcome outcome = run_program(arguments);
  EXPECT_TRUE(is_failure(outcome, 2)) << outcome;
  return outcome.err;
}

// By hand: from (0, 0, 4), a square picture and 2 tan(90° / 2) wide at distance 1: projection and
// view are these, and z is 0 at the near plane, at 4 − √2/16, and w at the far plane.
TEST(Import, LooksAtAMeshFromWhereTheUserSays) {
  const Outcome imported =
      run_program({"import", square_mesh(), "--eye", "-0,0,4", "--target", "0,0,-1", "--fov", "90",
                   "--samples", "4", "--rules", "d3d", "--up", "0,3,0"});
  ASSERT_EQ(imported.code, 0) << imported;
  EXPECT_EQ(imported.err, "");
  const auto c = cases::parse_case(imported.out, "-");
  ASSERT_TRUE(c) << to_string(c.error());
  EXPECT_EQ(c->framebuffer.samples, 4);
  EXPECT_EQ(c->camera->view, (cases::Matrix4{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, -4, 0, 0, 0, 1}));
  const cases::Matrix4& projection = c->camera->projection;
  EXPECT_FLOAT_EQ(projection[0], 1);
  EXPECT_FLOAT_EQ(projection[5], 1);
  const double near = 4 - std::numbers::sqrt2 / 16;
  EXPECT_NEAR(projection[10] * -near + projection[11], 0, 1e-4);
}

// Kills: a wrong option that shows another picture than the one asked for.
TEST(Import, RefusesViewsThatAreNone) {
  const auto of_options = [](const std::string& what) {
    return "rastercheck: " + what + " (see rastercheck import --help)\n";
  };
  for (const char* text :
       {"1,2", "1,2,3,4", "nan,0,0", "0,inf,0", "1,2,", "1 2 3", "x", "1e39,0,0"}) {
    for (const char* option : {"--eye", "--target", "--up"}) {
      EXPECT_EQ(refusal({option, text}), of_options(std::string(option) + ": '" + text +
                                                    "' is not X,Y,Z of finite numbers"));
    }
  }
  for (const char* text : {"0", "180", "-1", "200", "nan", "wide", "60,60"}) {
    EXPECT_EQ(refusal({"--fov", text}),
              of_options(std::string("--fov: '") + text + "' is not between 0 and 180"));
  }
  EXPECT_NE(refusal({"--samples", "3"}), "");
  EXPECT_EQ(
      refusal({"--eye", "1,2,3", "--target", "1,2,3"}),
      "rastercheck: " + square_mesh() + ": the eye lies at the target, 1,2,3 (--eye, --target)\n");
  EXPECT_EQ(refusal({"--eye", "0,5,0"}),
            "rastercheck: " + square_mesh() +
                ": the view goes along 0,1,0, which is to point up (--up X,Y,Z names another "
                "direction)\n");
  EXPECT_EQ(refusal({"--camera", "0"}),
            "rastercheck: " + square_mesh() + ": has no cameras, so no '0'\n");
  EXPECT_NE(refusal({"--camera", "0", "--fov", "60"}).find("--fov excludes --camera"),
            std::string::npos);
}

// Kills: a guess that nobody is told.
TEST(Import, SaysWhichCameraOfAFileIsUsed) {
  const TemporaryFolder folder;
  const std::string mesh =
      folder.put("a.gltf",
                 R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
          "nodes": [{"mesh": 0}, {"camera": 0, "translation": [0, 0, 9]}],
          "cameras": [{"name": "front", "type": "perspective",
                       "perspective": {"yfov": 0.5, "znear": 1}}],
          "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
          "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
          "bufferViews": [{"buffer": 0, "byteLength": 36}],
          "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,)" +
                     std::string("AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA") + R"("}]})");
  const std::string note = "rastercheck: " + mesh +
                           ": camera 0 'front' of 1 (--camera NAME|INDEX, or none to see all)\n";
  EXPECT_EQ(run_program({"import", mesh}).err, note);
  EXPECT_EQ(run_program({"import", mesh, "--quiet"}).err, "");
  EXPECT_EQ(run_program({"import", mesh, "--camera", "front"}).err, "");
  const Outcome run = run_program({"run", "--cases", "0", "--property", "cov*", "--scene", mesh,
                                   "--output", folder.path("out"), "--quiet"});
  EXPECT_EQ(run.code, 0) << run;
  EXPECT_EQ(run.err, note);
}

TEST(Import, AFileNameMayBeginLikeAnOption) {
  const Outcome outcome = run_program({"import", "--", "--no-such.obj"});
  EXPECT_TRUE(is_failure(outcome, 2)) << outcome;
  EXPECT_EQ(outcome.err, "rastercheck: --no-such.obj: cannot be read: No such file or directory\n");
}

}  // namespace
}  // namespace rastercheck::cli::import_test
