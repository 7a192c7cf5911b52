/* Renders one stroke over a runtime table (.shgt) to a WAV file in m/s^2.

   cc -std=c99 -O2 -I../../../crates/runtime-c/include render.c \
      ../../../target/release/libshagreen_runtime.a -lpthread -ldl -lm -o render
   ./render cork.shgt cork.wav 2

   The tip lands after 50 ms, moves to the right faster and faster, and lifts 0.3 s before the end. */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "shagreen.h"

#define RATE_HZ 48000
#define BLOCK 256

/* Reads a whole file. Returns NULL if that fails; the caller frees the bytes. */
static uint8_t *read_file(const char *path, size_t *n_bytes) {
  FILE *file = fopen(path, "rb");
  uint8_t *bytes = NULL;
  long length = 0;
  if (file == NULL) return NULL;
  if (fseek(file, 0, SEEK_END) == 0 && (length = ftell(file)) > 0 && fseek(file, 0, SEEK_SET) == 0) {
    bytes = malloc((size_t)length);
    *n_bytes = (size_t)length;
    if (bytes != NULL && fread(bytes, 1, *n_bytes, file) != *n_bytes) {
      free(bytes);
      bytes = NULL;
    }
  }
  fclose(file);
  return bytes;
}

static int put_u32(FILE *file, uint32_t value) {
  uint8_t bytes[4];
  int i;
  for (i = 0; i < 4; i++) bytes[i] = (uint8_t)(value >> (8 * i));
  return fwrite(bytes, 1, 4, file) == 4;
}

/* Writes samples as a WAV file of 32-bit floats, of one channel. Returns whether that succeeded. */
static int write_wav(const char *path, const float *samples, size_t n_samples) {
  const uint32_t n_bytes = (uint32_t)(4 * n_samples);
  FILE *file = fopen(path, "wb");
  size_t i;
  int ok;
  if (file == NULL) return 0;
  ok = fwrite("RIFF", 1, 4, file) == 4 && put_u32(file, 36 + n_bytes) && fwrite("WAVEfmt ", 1, 8, file) == 8 &&
       put_u32(file, 16) && put_u32(file, 3 | 1u << 16) && put_u32(file, RATE_HZ) && put_u32(file, 4 * RATE_HZ) &&
       put_u32(file, 4 | 32u << 16) && fwrite("data", 1, 4, file) == 4 && put_u32(file, n_bytes);
  for (i = 0; ok && i < n_samples; i++) {
    uint32_t bits;
    memcpy(&bits, &samples[i], 4);
    ok = put_u32(file, bits);
  }
  return fclose(file) == 0 && ok;
}

/* Renders the stroke. Returns the first status that is not OK. */
static ShagreenStatus render(ShagreenVoice *voice, float *samples, size_t n_blocks, double seconds) {
  double x_m = 0.0;
  int was_down = 0;
  size_t i;
  for (i = 0; i < n_blocks; i++) {
    const double t = (double)((i + 1) * BLOCK) / RATE_HZ;
    const int is_down = t >= 0.05 && t < seconds - 0.3;
    const double speed_mps = 0.2 * t / seconds;
    ShagreenTouch touch;
    ShagreenStatus status = SHAGREEN_STATUS_OK;
    x_m += speed_mps * BLOCK / RATE_HZ;
    touch.x_m = x_m;
    touch.y_m = 0.0;
    touch.speed_mps = (float)speed_mps;
    touch.force_n = is_down ? (float)(0.5 + t / seconds) : 0.0f;
    if (is_down && !was_down) status = shagreen_voice_tap(voice, 0.1f);
    was_down = is_down;
    if (status == SHAGREEN_STATUS_OK) {
      status = shagreen_voice_process(voice, &touch, 1, samples + i * BLOCK, BLOCK, NULL);
    }
    if (status != SHAGREEN_STATUS_OK) return status;
  }
  return SHAGREEN_STATUS_OK;
}

static int fail(const char *what, const char *why) {
  fprintf(stderr, "%s: %s\n", what, why);
  return EXIT_FAILURE;
}

int main(int argc, char **argv) {
  ShagreenTexture *texture = NULL;
  ShagreenVoice *voice = NULL;
  uint8_t *bytes = NULL;
  float *samples = NULL;
  size_t n_bytes = 0, n_blocks;
  double seconds;
  ShagreenStatus status;
  int code = EXIT_SUCCESS;
  if (argc < 3) return fail("usage", "render TABLE.shgt OUT.wav [SECONDS]");
  seconds = argc > 3 ? atof(argv[3]) : 2.0;
  if (!(seconds > 0.4 && seconds <= 600.0)) return fail(argv[3], "the length must be 0.4 to 600 seconds");
  if (shagreen_abi_version() != SHAGREEN_ABI_VERSION) return fail("libshagreen_runtime", "another version than the header");
  bytes = read_file(argv[1], &n_bytes);
  if (bytes == NULL) return fail(argv[1], "cannot be read");
  status = shagreen_texture_load(bytes, n_bytes, &texture);
  free(bytes);
  if (status != SHAGREEN_STATUS_OK) return fail(argv[1], shagreen_status_text(status));
  status = shagreen_voice_create(texture, (float)RATE_HZ, 500.0f, 7, &voice);
  n_blocks = (size_t)(seconds * RATE_HZ) / BLOCK;
  samples = malloc(n_blocks * BLOCK * sizeof *samples);
  if (status == SHAGREEN_STATUS_OK && samples != NULL) status = render(voice, samples, n_blocks, seconds);
  if (status != SHAGREEN_STATUS_OK) {
    code = fail(argv[1], shagreen_status_text(status));
  } else if (samples == NULL || !write_wav(argv[2], samples, n_blocks * BLOCK)) {
    code = fail(argv[2], "cannot be written");
  } else {
    printf("%s: %s, %.2f s\n", argv[2], shagreen_texture_name(texture), (double)(n_blocks * BLOCK) / RATE_HZ);
  }
  free(samples);
  shagreen_voice_destroy(voice);
  shagreen_texture_destroy(texture);
  return code;
}
