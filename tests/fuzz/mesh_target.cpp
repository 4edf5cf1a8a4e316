// The answer of the process that reads a mesh file, and the case that is made of it.

#include "cases/mesh.h"
#include "cases/mesh_process.h"
#include "tests/fuzz/target.h"

namespace {

using namespace rastercheck;
using fuzz::expect;

void check_mesh(const cases::Mesh& mesh) {
  const Result<cases::Mesh> again = cases::mesh_from_reply(cases::mesh_to_reply(mesh), "again");
  expect(again.has_value(), "a mesh that was written can be read");
  expect(*again == mesh, "a mesh that was written is read as the same");
  for (const cases::Rules rules : {cases::Rules::opengl, cases::Rules::vulkan, cases::Rules::d3d}) {
    const Result<cases::Case> c = cases::case_of_mesh(mesh, "a mesh.obj", {7, 5, rules});
    if (c) {
      fuzz::expect_round_trip(*c);
    } else {
      fuzz::expect_one_line(c.error());
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
