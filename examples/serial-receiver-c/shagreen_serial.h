/* A receiver of the Shagreen serial protocol, version 1: docs/serial-protocol.md is its description.
 *
 * C99, no memory to ask for, nothing to wait for: bytes go in by shagreen_receive, a sample comes out at every tick of the
 * sample clock by shagreen_tick, frames to send by shagreen_transmit. The three must not interrupt each other: call them
 * from one place, from interrupts of one priority, or with interrupts off.
 */
#ifndef SHAGREEN_SERIAL_H
#define SHAGREEN_SERIAL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Most samples that are queued, 8 to 32767: 10 ms at the rate are enough. */
#ifndef SHAGREEN_QUEUE
#define SHAGREEN_QUEUE 256
#endif

#define SHAGREEN_VERSION 1
/* Most bytes of a frame on the wire, and of a payload. */
#define SHAGREEN_MAX_WIRE 255
#define SHAGREEN_MAX_PAYLOAD 248
/* Most samples of a frame from the host, and of one of the accelerometer. */
#define SHAGREEN_MAX_SAMPLES 120
#define SHAGREEN_MAX_SENSOR 119

enum { SHAGREEN_STREAM = 0, SHAGREEN_CONTROL = 1 };
enum { SHAGREEN_UNCONFIGURED = 0, SHAGREEN_ARMED = 1, SHAGREEN_FILLING = 2, SHAGREEN_PLAYING = 3 };
enum { SHAGREEN_HAS_STREAM = 1, SHAGREEN_HAS_CONTROL = 2, SHAGREEN_HAS_SENSOR = 4 };

/* What the receiver says of itself. */
typedef struct {
    uint8_t flags; /* SHAGREEN_HAS_... */
    uint16_t rate_min_hz;
    uint16_t rate_max_hz;
    const char *name; /* UTF-8, at most 32 bytes are sent */
} shagreen_about;

/* How to play. A config of 0 is none. */
typedef struct {
    uint8_t config;
    uint8_t mode;
    uint16_t rate_hz;
    uint16_t ceiling;
    uint16_t watchdog_ms;
    uint16_t window;
    uint16_t prefill;
    uint16_t report;
    uint16_t fade;
    uint16_t full_scale_cmps2;
} shagreen_settings;

/* What the hand does. */
typedef struct {
    uint16_t speed_dmmps; /* tenths of mm/s */
    uint16_t force_mn;
    uint16_t texture; /* 0xFFFF is none */
    uint16_t gain_permille;
} shagreen_control;

/* All that it remembers. Only settings and control are for the firmware to read. */
typedef struct {
    shagreen_about about;
    shagreen_settings settings;
    shagreen_control control;
    /* The frame that arrives. */
    uint8_t frame[SHAGREEN_MAX_WIRE];
    uint16_t frame_len;
    bool is_overlong;
    /* Samples by their index, from the next to be played on. */
    int16_t samples[SHAGREEN_QUEUE];
    bool is_there[SHAGREEN_QUEUE];
    uint16_t head, len, base;
    bool has_base;
    /* The run. */
    uint8_t run;
    bool is_playing, is_falling;
    uint16_t gain;
    int16_t held;
    uint16_t control_seq;
    bool has_control_seq;
    uint32_t unfed_ticks, clock;
    uint16_t ticks_to_report;
    /* What the status tells. */
    uint16_t underruns, bad_frames, dropped, ping;
    /* What is to be sent. */
    uint16_t hello_nonce;
    bool is_hello_due, is_status_due, is_fault_due, has_stopped;
    const char *fault;
} shagreen_receiver;

/* A receiver right after a reset. */
void shagreen_init(shagreen_receiver *r, shagreen_about about);
/* Takes the next byte from the line. */
void shagreen_receive(shagreen_receiver *r, uint8_t byte);
/* The next sample to play; `rendered` counts in the mode of control only. */
int16_t shagreen_tick(shagreen_receiver *r, int16_t rendered);
/* Writes the next frame that is to be sent, and returns its length: 0 is none. */
size_t shagreen_transmit(shagreen_receiver *r, uint8_t wire[SHAGREEN_MAX_WIRE]);
/* Whether there is something to render, by r->control. */
bool shagreen_is_rendering(const shagreen_receiver *r);
/* SHAGREEN_UNCONFIGURED to SHAGREEN_PLAYING. */
uint8_t shagreen_state(const shagreen_receiver *r);
/* Tells the host that something is wrong; `text` must stay where it is. */
void shagreen_fault(shagreen_receiver *r, bool has_stopped, const char *text);
/* The sample clock stood still: drops what is queued. */
void shagreen_skip(shagreen_receiver *r);
/* Writes a frame with samples of an accelerometer, and returns its length. */
size_t shagreen_sensor(uint16_t seq, uint16_t rate_hz, uint32_t time_us, uint32_t scale_umps2, const int16_t *samples,
                       size_t n, uint8_t wire[SHAGREEN_MAX_WIRE]);

#endif
