// Shagreen's runtime in C++17: textures and voices that free themselves, and exceptions instead of statuses.
//
// Only `Voice::process` and `Voice::tap` may be called in an audio callback: they neither allocate nor throw.

#ifndef SHAGREEN_HPP
#define SHAGREEN_HPP

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <vector>

#include "shagreen.h"

namespace shagreen {

/// A status that is not `SHAGREEN_STATUS_OK`, as an exception.
class Error : public std::runtime_error {
 public:
  explicit Error(ShagreenStatus status) : std::runtime_error(shagreen_status_text(status)), status_(status) {}

  ShagreenStatus status() const noexcept { return status_; }

 private:
  ShagreenStatus status_;
};

/// Throws an `Error` unless the status is `SHAGREEN_STATUS_OK`.
inline void check(ShagreenStatus status) {
  if (status != SHAGREEN_STATUS_OK) throw Error(status);
}

/// Samples and friction of a block.
struct Played {
  ShagreenStatus status;
  /// Kinetic friction force in N.
  float friction_n;
};

/// A texture in memory. Any number of threads may use it.
class Texture {
 public:
  /// Loads the bytes of a runtime table, which are not needed afterwards.
  Texture(const std::uint8_t *bytes, std::size_t n_bytes) {
    ShagreenTexture *made = nullptr;
    check(shagreen_texture_load(bytes, n_bytes, &made));
    texture_.reset(made);
  }

  explicit Texture(const std::vector<std::uint8_t> &bytes) : Texture(bytes.data(), bytes.size()) {}

  ShagreenInfo info() const {
    ShagreenInfo info{};
    check(shagreen_texture_info(texture_.get(), &info));
    return info;
  }

  /// Name in UTF-8, valid as long as the texture.
  const char *name() const noexcept { return shagreen_texture_name(texture_.get()); }
  /// Terms of use in UTF-8, valid as long as the texture; empty if they are not known.
  const char *terms() const noexcept { return shagreen_texture_terms(texture_.get()); }
  /// Origin in UTF-8, valid as long as the texture; empty if it is not known.
  const char *origin() const noexcept { return shagreen_texture_origin(texture_.get()); }

  const ShagreenTexture *get() const noexcept { return texture_.get(); }

 private:
  struct Destroy {
    void operator()(ShagreenTexture *texture) const noexcept { shagreen_texture_destroy(texture); }
  };
  std::unique_ptr<ShagreenTexture, Destroy> texture_;
};

/// A texture under one tip. One thread at a time may use it. It may outlive its texture.
class Voice {
 public:
  Voice(const Texture &texture, float sample_rate_hz, float max_mps2, std::uint64_t seed) {
    ShagreenVoice *made = nullptr;
    check(shagreen_voice_create(texture.get(), sample_rate_hz, max_mps2, seed, &made));
    voice_.reset(made);
  }

  /// Fills the samples in m/s^2 with touches that are evenly spaced over them.
  Played process(const ShagreenTouch *touches, std::size_t n_touches, float *samples, std::size_t n_samples) noexcept {
    Played played{SHAGREEN_STATUS_OK, 0.0f};
    played.status =
        shagreen_voice_process(voice_.get(), touches, n_touches, samples, n_samples, &played.friction_n);
    return played;
  }

  /// The same with one touch, which is reached at the last sample.
  Played process(const ShagreenTouch &touch, float *samples, std::size_t n_samples) noexcept {
    return process(&touch, 1, samples, n_samples);
  }

  /// Starts the tap transient with the next sample, for a landing at this speed in m/s.
  ShagreenStatus tap(float impact_mps) noexcept { return shagreen_voice_tap(voice_.get(), impact_mps); }

  /// Returns to the state of a new voice.
  void reset() { check(shagreen_voice_reset(voice_.get())); }

  /// Delay in s from a touch to the middle of its ramp in the samples.
  float latency_secs() const noexcept { return shagreen_voice_latency_secs(voice_.get()); }

 private:
  struct Destroy {
    void operator()(ShagreenVoice *voice) const noexcept { shagreen_voice_destroy(voice); }
  };
  std::unique_ptr<ShagreenVoice, Destroy> voice_;
};

}  // namespace shagreen

#endif  // SHAGREEN_HPP
