// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/output/picture.hpp"

#include <png.h>

#include <string>

#include "pago/core/error.hpp"
#include "pago/output/text_file.hpp"

namespace pago::output {

Picture::Picture(int width, int height)
    : width_(width), height_(height), pixels_(static_cast<std::size_t>(width * height)) {}

void Picture::set(int x, int y, const Colour& colour) {
  if (x >= 0 && x < width_ && y >= 0 && y < height_)
    pixels_[static_cast<std::size_t>(y * width_ + x)] = colour;
}

void Picture::save(const std::filesystem::path& file) const {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width_);
  image.height = static_cast<png_uint_32>(height_);
  image.format = PNG_FORMAT_RGB;
  // Through memory: png_image_write_to_file() deletes a file that it cannot write, whatever it is.
  png_alloc_size_t size = 0;
  if (png_image_write_get_memory_size(image, size, 0, pixels_.data(), 0, nullptr) == 0)
    throw Error(file.string(), std::string("cannot be made: ") + image.message);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels_.data(), 0, nullptr) == 0)
    throw Error(file.string(), std::string("cannot be made: ") + image.message);
  bytes.resize(size);
  write_file(file, bytes);
}

}  // namespace pago::output
