// The answer of the process that reads a mesh file, and the case that is made of it.

#include <array>
#include <string>

#include "cases/mesh.h"
#include "cases/mesh_process.h"
#include "tests/fuzz/target.h"

namespace {

using namespace rastercheck;
using fuzz::expect;

const cases::View kFromAbove{std::array{0.5, 7.0, 0.25}, {}, std::array{0.0, 0.0, 1.0}, 30.0};

void check_case(const Result<cases::Imported>& made) {
  if (!made) {
    fuzz::expect_one_line(made.error());
    return;
  }
  fuzz::expect_round_trip(made->drawn);
  for (const std::string& note : made->notes) {
    expect(fuzz::is_one_line(note), "a note is one line");
  }
}

void check_mesh(const cases::Mesh& mesh) {
  const Result<cases::Mesh> again = cases::mesh_from_reply(cases::mesh_to_reply(mesh), "again");
  expect(again.has_value(), "a mesh that was written can be read");
  expect(*again == mesh, "a mesh that was written is read as the same");
  for (const cases::Rules rules : {cases::Rules::opengl, cases::Rules::vulkan, cases::Rules::d3d}) {
    check_case(cases::case_of_mesh(mesh, "a mesh.obj", {7, 5, rules}));
    check_case(cases::case_of_mesh(mesh, "a mesh.obj", {5, 7, rules, 4, kFromAbove, {}}));
    for (std::size_t i = 0; i < mesh.cameras.size(); ++i) {
      check_case(cases::case_of_mesh(mesh, "a mesh.obj", {7, 5, rules, 1, {}, std::to_string(i)}));
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Result<cases::Mesh> mesh = cases::mesh_from_reply(fuzz::text_of(data, size), "input");
  if (mesh) {
    check_mesh(*mesh);
  } else {
    fuzz::expect_one_line(mesh.error());
  }
  return 0;
}
