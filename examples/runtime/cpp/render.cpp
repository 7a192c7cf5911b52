/* Renders the stroke of ../c/render.c in C++17, and writes the samples as raw 32-bit floats in m/s^2.

   c++ -std=c++17 -O2 -I../../../crates/runtime-c/include render.cpp \
       ../../../target/release/libshagreen_runtime.a -lpthread -ldl -lm -o render
   ./render cork.shgt cork.f32 2 */

#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "shagreen.hpp"

namespace {

constexpr int kRateHz = 48000;
constexpr std::size_t kBlock = 256;

std::vector<std::uint8_t> read_file(const char *path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(std::string(path) + ": cannot be read");
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

double read_seconds(const char *text) {
  const double seconds = std::atof(text);
  if (!(seconds > 0.4 && seconds <= 600.0)) {
    throw std::runtime_error(std::string(text) + ": the length must be 0.4 to 600 seconds");
  }
  return seconds;
}

std::vector<float> render(shagreen::Voice &voice, double seconds) {
  const std::size_t n_blocks = static_cast<std::size_t>(seconds * kRateHz) / kBlock;
  std::vector<float> samples(n_blocks * kBlock);
  double x_m = 0.0;
  bool was_down = false;
  for (std::size_t i = 0; i < n_blocks; ++i) {
    const double t = static_cast<double>((i + 1) * kBlock) / kRateHz;
    const bool is_down = t >= 0.05 && t < seconds - 0.3;
    const double speed_mps = 0.2 * t / seconds;
    x_m += speed_mps * kBlock / kRateHz;
    const float force_n = is_down ? static_cast<float>(0.5 + t / seconds) : 0.0f;
    const ShagreenTouch touch{x_m, 0.0, static_cast<float>(speed_mps), force_n};
    if (is_down && !was_down) shagreen::check(voice.tap(0.1f));
    was_down = is_down;
    shagreen::check(voice.process(touch, &samples[i * kBlock], kBlock).status);
  }
  return samples;
}

}  // namespace

int main(int argc, char **argv) {
  if (argc < 3) {
    std::cerr << "usage: render TABLE.shgt OUT.f32 [SECONDS]\n";
    return EXIT_FAILURE;
  }
  try {
    if (shagreen_abi_version() != SHAGREEN_ABI_VERSION) {
      throw std::runtime_error("libshagreen_runtime: another version than the header");
    }
    const double seconds = argc > 3 ? read_seconds(argv[3]) : 2.0;
    const shagreen::Texture texture(read_file(argv[1]));
    shagreen::Voice voice(texture, kRateHz, 500.0f, 7);
    const std::vector<float> samples = render(voice, seconds);
    std::ofstream out(argv[2], std::ios::binary);
    out.write(reinterpret_cast<const char *>(samples.data()),
              static_cast<std::streamsize>(samples.size() * sizeof(float)));
    if (!out.flush()) throw std::runtime_error(std::string(argv[2]) + ": cannot be written");
    std::cout << argv[2] << ": " << texture.name() << ", terms of use: " << texture.terms() << '\n';
    return EXIT_SUCCESS;
  } catch (const std::exception &error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
  }
}
