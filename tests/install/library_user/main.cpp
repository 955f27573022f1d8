// SPDX-License-Identifier: MIT
// The whole of a program that improves a mesh.
#include <tetmend/improve.h>

int main() {
  tetmend::Mesh mesh = tetmend::load("part.mesh");
  tetmend::Result result =
      tetmend::improve(mesh, {.schedule = "thorough", .threads = 8, .time_limit = 60});
  tetmend::save("better.mesh", mesh);
}
