/* Runtime for textures that were exported from Shagreen: see docs/guide/runtime.md. */

#ifndef SHAGREEN_H
#define SHAGREEN_H

/* Generated from crates/runtime-c/src/abi.rs by its test "header". Do not edit it. */

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

/**
 * Version of this interface. It changes when a function, a struct or the meaning of one changes.
 */
#define SHAGREEN_ABI_VERSION 1

/**
 * The texture has a tap transient.
 */
#define SHAGREEN_TEXTURE_TAP 1

/**
 * The texture feels different along its lay.
 */
#define SHAGREEN_TEXTURE_ALONG 2

/**
 * The texture has a relief.
 */
#define SHAGREEN_TEXTURE_RELIEF 4

/**
 * The texture has a height map.
 */
#define SHAGREEN_TEXTURE_HEIGHT_MAP 8

/**
 * The friction of the texture is known.
 */
#define SHAGREEN_TEXTURE_FRICTION 16

/**
 * The texture must not be redistributed.
 */
#define SHAGREEN_TEXTURE_RESTRICTED 32

/**
 * Result of a function.
 */
typedef enum {
  /**
   * The function has done its work.
   */
  SHAGREEN_STATUS_OK = 0,
  /**
   * A pointer is null or misaligned.
   */
  SHAGREEN_STATUS_POINTER = 1,
  /**
   * A number of values is larger than any memory.
   */
  SHAGREEN_STATUS_TOO_LONG = 2,
  /**
   * The bytes are not a runtime table.
   */
  SHAGREEN_STATUS_FOREIGN = 3,
  /**
   * The runtime table has a newer version.
   */
  SHAGREEN_STATUS_VERSION = 4,
  /**
   * The runtime table is cut off or has extra bytes.
   */
  SHAGREEN_STATUS_INCOMPLETE = 5,
  /**
   * The runtime table is damaged.
   */
  SHAGREEN_STATUS_DAMAGED = 6,
  /**
   * The runtime table contains no valid texture.
   */
  SHAGREEN_STATUS_INVALID = 7,
  /**
   * The sample rate is below that of the texture or above 768 kHz, or that of the texture is not 200 to 4000 Hz.
   */
  SHAGREEN_STATUS_RATE = 8,
  /**
   * The highest magnitude is not a positive finite number.
   */
  SHAGREEN_STATUS_LIMIT = 9,
  /**
   * A sample was not finite. The voice is silent until it is reset.
   */
  SHAGREEN_STATUS_SILENCED = 10,
  /**
   * A fault of the runtime.
   */
  SHAGREEN_STATUS_INTERNAL = 11,
} ShagreenStatus;

/**
 * A texture in memory. Any number of threads may use it at the same time, until it is freed.
 */
typedef struct ShagreenTexture ShagreenTexture;

/**
 * A texture under one tip. One thread at a time may use it. It stays valid when its texture is freed.
 */
typedef struct ShagreenVoice ShagreenVoice;

/**
 * Numbers of a texture.
 */
typedef struct {
  /**
   * Memory that the texture takes, in bytes.
   */
  uint64_t memory_bytes;
  /**
   * Sample rate of the texture model, in Hz. It is the lowest sample rate of a voice.
   */
  float rate_hz;
  /**
   * Speed in m/s above which the texture no longer changes.
   */
  float speed_max_mps;
  /**
   * Normal force in N above which the texture no longer changes.
   */
  float force_max_n;
  /**
   * Nodes over speed and force, across the lay.
   */
  uint32_t n_nodes;
  /**
   * Triangles between the nodes.
   */
  uint32_t n_triangles;
  /**
   * Properties of the texture: the sum of values such as `SHAGREEN_TEXTURE_TAP`.
   */
  uint32_t flags;
} ShagreenInfo;

/**
 * Tip at one moment. A speed or force that is negative or not finite counts as zero, and a position that is not finite as the
 * last one.
 */
typedef struct {
  /**
   * Position to the right, in m.
   */
  double x_m;
  /**
   * Position upwards, in m.
   */
  double y_m;
  /**
   * Speed over the surface, in m/s.
   */
  float speed_mps;
  /**
   * Normal force in N; zero while the tip is lifted.
   */
  float force_n;
} ShagreenTouch;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * Version of the interface of this library. Compare it with `SHAGREEN_ABI_VERSION` of the header.
 */
uint32_t shagreen_abi_version(void);

/**
 * One sentence in English about a status, in UTF-8: what is wrong, and what to do. The text is never freed.
 */
const char *shagreen_status_text(int32_t status);

/**
 * Loads a texture from the bytes of a runtime table, which are not needed afterwards. On an error, `texture` becomes null. The
 * function allocates memory, so no audio callback may call it.
 *
 * # Safety
 * `bytes` points to `n_bytes` bytes, and `texture` to a pointer.
 */
ShagreenStatus shagreen_texture_load(const uint8_t *bytes,
                                     size_t n_bytes,
                                     ShagreenTexture **texture);

/**
 * Frees a texture; null is ignored. Voices of the texture stay valid. No audio callback may call the function.
 *
 * # Safety
 * `texture` is null, or comes from `shagreen_texture_load` and was not freed before.
 */
void shagreen_texture_destroy(ShagreenTexture *texture);

/**
 * Writes the numbers of a texture.
 *
 * # Safety
 * `texture` comes from `shagreen_texture_load` and is not freed. `info` points to a struct.
 */
ShagreenStatus shagreen_texture_info(const ShagreenTexture *texture, ShagreenInfo *info);

/**
 * Name of a texture in UTF-8; null for a null pointer. The text is valid until the texture is freed.
 *
 * # Safety
 * `texture` is null, or comes from `shagreen_texture_load` and is not freed.
 */
const char *shagreen_texture_name(const ShagreenTexture *texture);

/**
 * Terms of use of a texture in UTF-8; empty if they are not known, null for a null pointer. The text is valid until the
 * texture is freed.
 *
 * # Safety
 * `texture` is null, or comes from `shagreen_texture_load` and is not freed.
 */
const char *shagreen_texture_terms(const ShagreenTexture *texture);

/**
 * Origin of a texture in UTF-8; empty if it is not known, null for a null pointer. The text is valid until the texture is
 * freed.
 *
 * # Safety
 * `texture` is null, or comes from `shagreen_texture_load` and is not freed.
 */
const char *shagreen_texture_origin(const ShagreenTexture *texture);

/**
 * Memory of a voice in bytes, without its texture.
 */
size_t shagreen_voice_size_bytes(void);

/**
 * Makes a voice: a lifted tip on a texture. On an error, `voice` becomes null.
 *
 * `sample_rate_hz` is at least the rate of the texture. No sample is above `max_mps2` in m/s², and those above four fifths of
 * it are attenuated. The same `seed` gives the same noise. The function allocates memory, so no audio callback may call it.
 *
 * # Safety
 * `texture` comes from `shagreen_texture_load` and is not freed. `voice` points to a pointer.
 */
ShagreenStatus shagreen_voice_create(const ShagreenTexture *texture,
                                     float sample_rate_hz,
                                     float max_mps2,
                                     uint64_t seed,
                                     ShagreenVoice **voice);

/**
 * Frees a voice; null is ignored. No audio callback may call the function.
 *
 * # Safety
 * `voice` is null, or comes from `shagreen_voice_create` and was not freed before.
 */
void shagreen_voice_destroy(ShagreenVoice *voice);

/**
 * Fills `samples` with the next accelerations in m/s². On an error they are all zero.
 *
 * The touches are evenly spaced over the block, and the last one is reached at its last sample. With `n_touches` 0, the tip
 * stays. `friction_n` may be null; otherwise it becomes the kinetic friction force in N at the last touch, zero for a
 * texture whose friction is not known. The function neither allocates nor waits, so an audio callback may call it.
 *
 * # Safety
 * `voice` comes from `shagreen_voice_create` and is not freed. `touches` points to `n_touches` structs, `samples` to
 * `n_samples` floats, and they do not overlap. No other function uses the voice at the same time.
 */
ShagreenStatus shagreen_voice_process(ShagreenVoice *voice,
                                      const ShagreenTouch *touches,
                                      size_t n_touches,
                                      float *samples,
                                      size_t n_samples,
                                      float *friction_n);

/**
 * Starts the tap transient of the texture with the next sample, for a tip that lands at `impact_mps` in m/s; NaN if that is
 * not known. A texture without a tap transient stays silent.
 *
 * # Safety
 * `voice` comes from `shagreen_voice_create` and is not freed. No other function uses it at the same time.
 */
ShagreenStatus shagreen_voice_tap(ShagreenVoice *voice,
                                  float impact_mps);

/**
 * Returns a voice to the state in which it was made, with the same noise. It takes about as long as to make one.
 *
 * # Safety
 * `voice` comes from `shagreen_voice_create` and is not freed. No other function uses it at the same time.
 */
ShagreenStatus shagreen_voice_reset(ShagreenVoice *voice);

/**
 * Delay in s from a touch to the middle of its ramp in the samples, beside the time until its block; NaN for a null pointer.
 *
 * # Safety
 * `voice` is null, or comes from `shagreen_voice_create` and is not freed.
 */
float shagreen_voice_latency_secs(const ShagreenVoice *voice);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* SHAGREEN_H */
