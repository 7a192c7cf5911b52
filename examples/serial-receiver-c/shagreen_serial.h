/* Receiver of the Shagreen serial protocol, version 1, as specified in docs/serial-protocol.md.
 *
 * C99, without dynamic allocation or blocking. shagreen_receive takes bytes from the line, shagreen_tick returns a
 * sample at every tick of the sample clock, and shagreen_transmit writes frames to send. The three must not interrupt
 * each other: call them from one context, from interrupts of equal priority, or with interrupts disabled.
 */
#ifndef SHAGREEN_SERIAL_H
#define SHAGREEN_SERIAL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Queue size in samples, 8 to 32767; 10 ms at the sample rate are enough. */
#ifndef SHAGREEN_QUEUE
#define SHAGREEN_QUEUE 256
#endif

#define SHAGREEN_VERSION 1
/* Largest frame on the wire and largest payload, in bytes. */
#define SHAGREEN_MAX_WIRE 255
#define SHAGREEN_MAX_PAYLOAD 248
/* Largest number of samples in a frame from the host, and in an accelerometer frame. */
#define SHAGREEN_MAX_SAMPLES 120
#define SHAGREEN_MAX_SENSOR 119

enum { SHAGREEN_STREAM = 0, SHAGREEN_CONTROL = 1, SHAGREEN_FRICTION = 2 };
enum { SHAGREEN_UNCONFIGURED = 0, SHAGREEN_ARMED = 1, SHAGREEN_FILLING = 2, SHAGREEN_PLAYING = 3 };
enum { SHAGREEN_HAS_STREAM = 1, SHAGREEN_HAS_CONTROL = 2, SHAGREEN_HAS_SENSOR = 4, SHAGREEN_HAS_FRICTION = 8 };

/* Capabilities that the receiver reports. */
typedef struct {
    uint8_t flags; /* SHAGREEN_HAS_... */
    uint16_t rate_min_hz;
    uint16_t rate_max_hz;
    const char *name; /* UTF-8; at most 32 bytes are sent */
} shagreen_about;

/* Playback settings from the host; a config of 0 means not configured. */
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

/* Stroke state in control mode. */
typedef struct {
    uint16_t speed_dmmps; /* tenths of mm/s */
    uint16_t force_mn;
    uint16_t texture; /* 0xFFFF: no texture */
    uint16_t gain_permille;
} shagreen_control;

/* State of the receiver. Firmware may only read settings and control. */
typedef struct {
    shagreen_about about;
    shagreen_settings settings;
    shagreen_control control;
    /* Incoming frame. */
    uint8_t frame[SHAGREEN_MAX_WIRE];
    uint16_t frame_len;
    bool is_overlong;
    /* Queued samples in order of their index, starting with the next one to play. */
    int16_t samples[SHAGREEN_QUEUE];
    bool is_there[SHAGREEN_QUEUE];
    uint16_t head, len, base;
    bool has_base;
    /* Current run. */
    uint8_t run;
    bool is_playing, is_falling;
    uint16_t gain;
    int16_t held;
    uint16_t control_seq;
    bool has_control_seq;
    uint32_t unfed_ticks, clock;
    uint16_t ticks_to_report;
    /* Counters of the status frame. */
    uint16_t underruns, bad_frames, dropped, ping;
    /* Pending frames to send. */
    uint16_t hello_nonce;
    bool is_hello_due, is_status_due, is_fault_due, has_stopped;
    const char *fault;
} shagreen_receiver;

/* Initializes a receiver, as after a reset. */
void shagreen_init(shagreen_receiver *r, shagreen_about about);
/* Processes the next byte from the line. */
void shagreen_receive(shagreen_receiver *r, uint8_t byte);
/* Returns the next sample to play; `rendered` is used in control mode only. In friction mode it is a level of friction,
 * 0 to 32767. */
int16_t shagreen_tick(shagreen_receiver *r, int16_t rendered);
/* Writes the next frame to send, and returns its length in bytes; 0 if there is none. */
size_t shagreen_transmit(shagreen_receiver *r, uint8_t wire[SHAGREEN_MAX_WIRE]);
/* Returns whether the firmware should render from r->control. */
bool shagreen_is_rendering(const shagreen_receiver *r);
/* Returns the state, SHAGREEN_UNCONFIGURED to SHAGREEN_PLAYING. */
uint8_t shagreen_state(const shagreen_receiver *r);
/* Reports a fault to the host; `text` must stay valid until it is sent. */
void shagreen_fault(shagreen_receiver *r, bool has_stopped, const char *text);
/* Drops the queue after the sample clock was suspended. */
void shagreen_skip(shagreen_receiver *r);
/* Writes a frame with accelerometer samples, and returns its length in bytes. */
size_t shagreen_sensor(uint16_t seq, uint16_t rate_hz, uint32_t time_us, uint32_t scale_umps2, const int16_t *samples,
                       size_t n, uint8_t wire[SHAGREEN_MAX_WIRE]);

#endif
