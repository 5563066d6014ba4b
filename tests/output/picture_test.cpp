// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/output/picture.hpp"

#include <png.h>

#include "output/scratch_folder.hpp"
#include "pago/core/error.hpp"
#include "support/catch.hpp"

using namespace pago::output;
using pago::test::ScratchFolder;

TEST_CASE("a saved picture has its pixels where they were set", "[output][picture]") {
  const ScratchFolder scratch;
  Picture picture(3, 2);
  picture.set(0, 0, {255, 0, 0});
  picture.set(2, 1, {1, 2, 3});
  for (const auto& [x, y] : {std::pair{-1, 0}, {3, 0}, {0, 2}, {0, -1}}) picture.set(x, y, {9, 9, 9});
  picture.save(scratch.path / "picture.png");

  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  REQUIRE(png_image_begin_read_from_file(&image, (scratch.path / "picture.png").c_str()) != 0);
  image.format = PNG_FORMAT_RGB;
  REQUIRE(image.width == 3);
  REQUIRE(image.height == 2);
  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(image));
  REQUIRE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr) != 0);
  CHECK(pixels == std::vector<std::uint8_t>{255, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 3});
}

TEST_CASE("a picture that cannot be written is an Error", "[output][picture]") {
  CHECK_THROWS_AS(Picture(2, 2).save("/dev/full"), pago::Error);
}
