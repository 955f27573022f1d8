// SPDX-License-Identifier: MIT
// A document with a host that draws nothing.
#pragma once

#include "tests/support/zoo.h"
#include "viewer/commands/commands.h"

namespace tetmend::test {

class BlankHost : public viewer::Host {
 public:
  void arrange(viewer::Document&) override {}
  viewer::Image render(viewer::Document& document) override {
    const auto& size = document.window;
    const auto count = static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
    return {size.width, size.height, std::vector<viewer::Colour>(count)};
  }
  void set_clipboard(const std::string& text) override { text_ = text; }
  std::string clipboard() override { return text_; }

 private:
  std::string text_;
};

struct TestSession {
  explicit TestSession(const MeshData& data) {
    document.resize({400, 300});
    document.set_mesh(TetMesh(data), "test.mesh");
  }
  viewer::Document document;
  BlankHost host;
  viewer::Session session{document, host};

  nlohmann::json run(std::string_view command, const nlohmann::json& arguments = {}) {
    return viewer::find_command(command).run(session, arguments);
  }
};

/// Of a trace; a tet was looked at before.
struct TraceSession : TestSession {
  explicit TraceSession(const std::filesystem::path& trace) : TestSession(one_tet()) {
    document.open(trace);
  }
};

}  // namespace tetmend::test
