/* See shagreen_serial.h. Mirrors crates/device/src/serial/receiver.rs line by line. */
#include "shagreen_serial.h"

#include <string.h>

enum { HELLO = 0x01, CONFIGURE = 0x02, SAMPLES = 0x03, CONTROL = 0x04, STOP = 0x05, PING = 0x06 };
enum { HELLO_REPLY = 0x81, STATUS = 0x82, SENSOR = 0x83, FAULT = 0x84 };
enum { HEADER = 3, CHECKSUM = 2, MAX_NAME = 32, MAX_FAULT = 64 };
/* Next item of the queue. */
enum { SAMPLE, HOLE, EMPTY };

static uint16_t least(uint32_t a, uint32_t b) { return (uint16_t)(a < b ? a : b); }

static uint16_t at_least_1(uint16_t x) { return x == 0 ? 1 : x; }

static uint16_t get16(const uint8_t *bytes) { return (uint16_t)(bytes[0] | (uint16_t)bytes[1] << 8); }

static int16_t get_sample(const uint8_t *bytes)
{
    uint16_t x = get16(bytes);
    return (int16_t)(x < 0x8000 ? (int32_t)x : (int32_t)x - 0x10000);
}

/* Returns the signed distance from b to a, modulo 2^16. */
static int32_t ahead(uint16_t a, uint16_t b)
{
    uint16_t distance = (uint16_t)(a - b);
    return distance < 0x8000 ? (int32_t)distance : (int32_t)distance - 0x10000;
}

/* CRC-16/CCITT-FALSE. A lookup table or a hardware CRC unit is faster. */
static uint16_t checksum(const uint8_t *bytes, size_t n)
{
    uint16_t crc = 0xFFFF;
    for (size_t i = 0; i < n; i++) {
        crc = (uint16_t)(crc ^ (uint16_t)bytes[i] << 8);
        for (int bit = 0; bit < 8; bit++) {
            crc = (uint16_t)((crc & 0x8000) ? (uint16_t)(crc << 1) ^ 0x1021 : crc << 1);
        }
    }
    return crc;
}

/* A frame under construction, before byte stuffing (COBS). */
typedef struct {
    uint8_t bytes[HEADER + SHAGREEN_MAX_PAYLOAD + CHECKSUM];
    size_t len;
} plain;

static void put8(plain *p, uint8_t x) { p->bytes[p->len++] = x; }

static void put16(plain *p, uint16_t x)
{
    put8(p, (uint8_t)(x & 0xFF));
    put8(p, (uint8_t)(x >> 8));
}

static void put32(plain *p, uint32_t x)
{
    put16(p, (uint16_t)(x & 0xFFFF));
    put16(p, (uint16_t)(x >> 16));
}

static void begin(plain *p, uint8_t kind, uint16_t seq)
{
    p->len = 0;
    put8(p, kind);
    put16(p, seq);
}

/* Appends the checksum, applies byte stuffing, and ends the frame with a zero. */
static size_t finish(plain *p, uint8_t *wire)
{
    put16(p, checksum(p->bytes, p->len));
    size_t code = 0, len = 1;
    for (size_t i = 0; i < p->len; i++) {
        if (p->bytes[i] == 0) {
            wire[code] = (uint8_t)(len - code);
            code = len++;
        } else {
            wire[len++] = p->bytes[i];
        }
    }
    wire[code] = (uint8_t)(len - code);
    wire[len++] = 0;
    return len;
}

/* Removes byte stuffing in place; returns the length, or 0 if the bytes are not a valid frame. */
static size_t unstuff(uint8_t *bytes, size_t len)
{
    size_t from = 0, to = 0;
    while (from < len) {
        size_t code = bytes[from++];
        if (code == 0xFF || from + code - 1 > len) {
            return 0;
        }
        for (size_t i = 1; i < code; i++) {
            bytes[to++] = bytes[from++];
        }
        if (from < len) {
            bytes[to++] = 0;
        }
    }
    return to;
}

static void clear_queue(shagreen_receiver *r)
{
    r->len = 0;
    r->has_base = false;
}

static uint16_t put_samples(shagreen_receiver *r, uint16_t seq, const uint8_t *bytes, uint16_t n)
{
    uint16_t n_new = 0;
    if (!r->has_base) {
        r->has_base = true;
        r->base = seq;
    }
    for (uint16_t i = 0; i < n; i++) {
        int32_t offset = ahead((uint16_t)(seq + i), r->base);
        if (offset < 0 || offset >= (int32_t)r->settings.window) {
            continue;
        }
        while ((int32_t)r->len <= offset) {
            r->is_there[((uint32_t)r->head + r->len) % SHAGREEN_QUEUE] = false;
            r->len++;
        }
        uint32_t place = ((uint32_t)r->head + (uint32_t)offset) % SHAGREEN_QUEUE;
        if (!r->is_there[place]) {
            r->samples[place] = get_sample(bytes + 2 * i);
            r->is_there[place] = true;
            n_new++;
        }
    }
    return n_new;
}

static int take_sample(shagreen_receiver *r, int16_t *sample)
{
    if (r->len == 0) {
        return EMPTY;
    }
    uint16_t place = r->head;
    r->head = (uint16_t)((place + 1u) % SHAGREEN_QUEUE);
    r->len--;
    r->base++;
    *sample = r->samples[place];
    return r->is_there[place] ? SAMPLE : HOLE;
}

/* Drops the queue and fades out. Samples in transit carry the number of the old run and are not played. */
static void end_run(shagreen_receiver *r)
{
    r->run++;
    clear_queue(r);
    r->has_control_seq = false;
    r->unfed_ticks = 0;
    r->is_playing = false;
    r->is_falling = r->gain > 0;
    r->is_status_due = true;
}

static void starve(shagreen_receiver *r)
{
    r->underruns++;
    end_run(r);
}

static void forget(shagreen_receiver *r)
{
    end_run(r);
    r->settings.config = 0;
}

static bool configure(shagreen_receiver *r, const uint8_t *p, size_t len)
{
    static const uint8_t flags[] = {SHAGREEN_HAS_STREAM, SHAGREEN_HAS_CONTROL, SHAGREEN_HAS_FRICTION};
    if (len < 18 || p[0] == 0 || p[1] > SHAGREEN_FRICTION || get16(p + 2) == 0) {
        return false;
    }
    uint8_t flag = flags[p[1]];
    uint16_t rate_hz = get16(p + 2);
    if (!(r->about.flags & flag) || rate_hz < r->about.rate_min_hz || rate_hz > r->about.rate_max_hz) {
        shagreen_fault(r, true, "no such mode or rate");
        return true;
    }
    shagreen_settings s;
    s.config = p[0];
    s.mode = p[1];
    s.rate_hz = rate_hz;
    s.ceiling = least(get16(p + 4), 0x7FFF);
    s.watchdog_ms = get16(p + 6);
    s.window = at_least_1(least(get16(p + 8), SHAGREEN_QUEUE));
    s.prefill = at_least_1(least(get16(p + 10), s.window));
    s.report = at_least_1(get16(p + 12));
    s.fade = at_least_1(get16(p + 14));
    s.full_scale_cmps2 = get16(p + 16);
    end_run(r);
    r->gain = least(r->gain, s.fade);
    r->settings = s;
    r->clock = 0;
    r->ticks_to_report = s.report;
    return true;
}

static bool take_samples(shagreen_receiver *r, uint16_t seq, const uint8_t *p, size_t len)
{
    if (len < 3 || len % 2 == 0 || (len - 1) / 2 > SHAGREEN_MAX_SAMPLES) {
        return false;
    }
    uint16_t n = (uint16_t)((len - 1) / 2), n_new = 0;
    if (r->settings.config != 0 && r->settings.mode != SHAGREEN_CONTROL && p[0] == r->run) {
        r->unfed_ticks = 0;
        n_new = put_samples(r, seq, p + 1, n);
    }
    r->dropped = (uint16_t)(r->dropped + n - n_new);
    r->is_status_due |= r->settings.config == 0;
    return true;
}

static bool take_control(shagreen_receiver *r, uint16_t seq, const uint8_t *p, size_t len)
{
    if (len < 9) {
        return false;
    }
    bool is_newer = !r->has_control_seq || ahead(seq, r->control_seq) > 0;
    if (r->settings.config != 0 && r->settings.mode == SHAGREEN_CONTROL && p[0] == r->run && is_newer) {
        r->control.speed_dmmps = get16(p + 1);
        r->control.force_mn = get16(p + 3);
        r->control.texture = get16(p + 5);
        r->control.gain_permille = get16(p + 7);
        r->control_seq = seq;
        r->has_control_seq = true;
        r->is_playing = true;
        r->unfed_ticks = 0;
    } else {
        r->dropped++;
    }
    r->is_status_due |= r->settings.config == 0;
    return true;
}

/* Executes a message; returns whether its payload is valid for its type. */
static bool obey(shagreen_receiver *r, uint8_t kind, uint16_t seq, const uint8_t *p, size_t len)
{
    switch (kind) {
    case HELLO:
        if (len < 1) {
            return false;
        }
        forget(r);
        r->hello_nonce = seq;
        r->is_hello_due = true;
        return true;
    case CONFIGURE:
        return configure(r, p, len);
    case SAMPLES:
        return take_samples(r, seq, p, len);
    case CONTROL:
        return take_control(r, seq, p, len);
    case STOP:
        end_run(r);
        return true;
    case PING:
        r->ping = seq;
        r->is_status_due = true;
        return true;
    default: /* message of a later protocol version */
        return true;
    }
}

void shagreen_init(shagreen_receiver *r, shagreen_about about)
{
    memset(r, 0, sizeof *r);
    r->about = about;
    r->control.texture = 0xFFFF;
    r->settings.rate_hz = r->settings.prefill = r->settings.report = r->settings.fade = 1;
    r->is_hello_due = true;
}

void shagreen_receive(shagreen_receiver *r, uint8_t byte)
{
    if (byte != 0) {
        if (r->frame_len < sizeof r->frame) {
            r->frame[r->frame_len++] = byte;
        } else {
            r->is_overlong = true;
        }
        return;
    }
    size_t len = r->frame_len;
    bool is_overlong = r->is_overlong;
    r->frame_len = 0;
    r->is_overlong = false;
    if (len == 0 && !is_overlong) {
        return; /* repeated zeros between frames are ignored */
    }
    len = is_overlong ? 0 : unstuff(r->frame, len);
    if (len < HEADER + CHECKSUM || len > HEADER + SHAGREEN_MAX_PAYLOAD + CHECKSUM
        || checksum(r->frame, len - CHECKSUM) != get16(r->frame + len - CHECKSUM)
        || !obey(r, r->frame[0], get16(r->frame + 1), r->frame + HEADER, len - HEADER - CHECKSUM)) {
        r->bad_frames++;
    }
}

int16_t shagreen_tick(shagreen_receiver *r, int16_t rendered)
{
    const shagreen_settings *s = &r->settings;
    int16_t sample = rendered;
    int next = EMPTY;
    if (s->config != 0) {
        r->clock++;
        if (--r->ticks_to_report == 0) {
            r->ticks_to_report = s->report;
            r->is_status_due = true;
        }
        if (r->is_playing || r->has_base) {
            uint32_t most = (uint32_t)s->watchdog_ms * s->rate_hz / 1000;
            if (++r->unfed_ticks >= (most > 0 ? most : 1)) {
                starve(r);
            }
        }
    }
    if (s->mode == SHAGREEN_CONTROL) {
        next = r->is_playing ? SAMPLE : EMPTY;
    } else {
        if (!r->is_playing && r->gain == 0 && r->len >= s->prefill) {
            r->is_playing = true;
        }
        if (r->is_playing) {
            next = take_sample(r, &sample);
        }
    }
    if (r->is_falling) {
        r->gain = (uint16_t)(r->gain > 0 ? r->gain - 1 : 0);
        if (r->gain == 0) {
            r->is_falling = false;
            if (r->is_playing && r->len == 0 && s->mode != SHAGREEN_CONTROL) {
                starve(r);
            }
        }
    } else if (next == SAMPLE) {
        r->held = sample;
        r->gain = least(r->gain + 1u, s->fade);
    } else if (r->gain > 0) {
        r->gain--;
        r->is_falling = r->gain > 0;
    } else if (next == EMPTY && r->is_playing) {
        starve(r);
    }
    int32_t faded = (int32_t)r->held * r->gain / s->fade;
    int32_t ceiling = s->ceiling, floor = s->mode == SHAGREEN_FRICTION ? 0 : -ceiling;
    return (int16_t)(faded > ceiling ? ceiling : faded < floor ? floor : faded);
}

size_t shagreen_transmit(shagreen_receiver *r, uint8_t wire[SHAGREEN_MAX_WIRE])
{
    plain p;
    if (r->is_hello_due) {
        r->is_hello_due = false;
        size_t len = strlen(r->about.name);
        len = len < MAX_NAME ? len : MAX_NAME;
        begin(&p, HELLO_REPLY, r->hello_nonce);
        put8(&p, SHAGREEN_VERSION);
        put8(&p, r->about.flags);
        put16(&p, r->about.rate_min_hz);
        put16(&p, r->about.rate_max_hz);
        put16(&p, SHAGREEN_QUEUE);
        put8(&p, SHAGREEN_MAX_SAMPLES);
        put8(&p, (uint8_t)len);
        for (size_t i = 0; i < len; i++) {
            put8(&p, (uint8_t)r->about.name[i]);
        }
        return finish(&p, wire);
    }
    if (r->is_fault_due) {
        r->is_fault_due = false;
        begin(&p, FAULT, 0);
        put8(&p, r->has_stopped ? 1 : 0);
        for (size_t i = 0; i < MAX_FAULT && r->fault[i] != 0; i++) {
            put8(&p, (uint8_t)r->fault[i]);
        }
        return finish(&p, wire);
    }
    if (r->is_status_due) {
        r->is_status_due = false;
        const shagreen_settings *s = &r->settings;
        begin(&p, STATUS, (uint16_t)((r->has_base ? r->base : 0) + r->len));
        put8(&p, s->config);
        put8(&p, r->run);
        put8(&p, shagreen_state(r));
        put16(&p, (uint16_t)(s->config == 0 || s->window < r->len ? 0 : s->window - r->len));
        put16(&p, r->len);
        put32(&p, r->clock);
        put16(&p, r->underruns);
        put16(&p, r->bad_frames);
        put16(&p, r->dropped);
        put16(&p, r->ping);
        return finish(&p, wire);
    }
    return 0;
}

bool shagreen_is_rendering(const shagreen_receiver *r)
{
    return r->settings.mode == SHAGREEN_CONTROL && r->is_playing;
}

uint8_t shagreen_state(const shagreen_receiver *r)
{
    if (r->settings.config == 0) {
        return SHAGREEN_UNCONFIGURED;
    }
    return r->is_playing ? SHAGREEN_PLAYING : r->has_base ? SHAGREEN_FILLING : SHAGREEN_ARMED;
}

void shagreen_fault(shagreen_receiver *r, bool has_stopped, const char *text)
{
    r->is_fault_due = true;
    r->has_stopped = has_stopped;
    r->fault = text;
    if (has_stopped) {
        forget(r);
    }
}

void shagreen_skip(shagreen_receiver *r) { end_run(r); }

size_t shagreen_sensor(uint16_t seq, uint16_t rate_hz, uint32_t time_us, uint32_t scale_umps2, const int16_t *samples,
                       size_t n, uint8_t wire[SHAGREEN_MAX_WIRE])
{
    plain p;
    begin(&p, SENSOR, seq);
    put16(&p, rate_hz);
    put32(&p, time_us);
    put32(&p, scale_umps2);
    for (size_t i = 0; i < n && i < SHAGREEN_MAX_SENSOR; i++) {
        put16(&p, (uint16_t)samples[i]);
    }
    return finish(&p, wire);
}
