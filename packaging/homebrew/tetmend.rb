# SPDX-License-Identifier: MIT
# A formula for Homebrew on Linux: brew install --build-from-source --HEAD ./packaging/homebrew/tetmend.rb, in a clone of the
# source. It has no url: there is no release yet.
# What was run: script/recipes, on 2026-11-25, which reads it and gives its options to CMake.
# Not run: a build with them, script/recipes --build; brew.
class Tetmend < Formula
  desc "Improves tetrahedral meshes and keeps their surface"
  homepage "https://tetmend.invalid"
  license "MIT"
  head "file://#{File.expand_path("../..", __dir__)}", using: :git, branch: "main"

  depends_on "cli11" => :build
  depends_on "cmake" => :build
  depends_on "eigen" => :build
  depends_on "fast_float" => :build
  depends_on "ninja" => :build
  depends_on "nlohmann-json" => :build
  depends_on "pkgconf" => :build
  depends_on "fmt"
  depends_on :linux
  depends_on "lua@5.4"
  depends_on "pugixml"
  depends_on "tbb"
  depends_on "zlib"
  depends_on "zstd"

  def install
    system "cmake", "-S", ".", "-B", "build", "-G", "Ninja", "-DTETMEND_LUA=lua5.4;lua", "-DTETMEND_BUILD_TESTS=OFF",
           "-DTETMEND_BUILD_VIEWER=OFF", "-DTETMEND_MPI=OFF", *std_cmake_args
    system "cmake", "--build", "build"
    system "cmake", "--install", "build"
    pkgshare.install "assets/meshes/sheet.mesh"
  end

  test do
    system bin/"tetmend", "improve", pkgshare/"sheet.mesh", "-o", "better.mesh"
    system bin/"tetmend", "check", pkgshare/"sheet.mesh", "better.mesh"
  end
end
