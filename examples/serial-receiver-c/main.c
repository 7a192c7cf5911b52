/* The receiver on a computer, to test firmware logic without a board.
 *
 *   receiver PORT OUT.raw SECONDS   plays a serial port at the rate of the computer's clock, and saves 16-bit samples
 *   receiver < STEPS > PLAYED       runs steps from stdin: a byte n, n bytes from the line, a byte with the number of
 *                                   ticks. Output per step: the samples of its ticks, each frame to send preceded by
 *                                   its length, and a 0
 */
#define _POSIX_C_SOURCE 200809L

#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

#include "shagreen_serial.h"

static shagreen_receiver receiver;

static void put_sample(FILE *out, int16_t sample)
{
    fputc((uint16_t)sample & 0xFF, out);
    fputc((uint16_t)sample >> 8, out);
}

static int play_steps(void)
{
    uint8_t wire[SHAGREEN_MAX_WIRE];
    int n, byte;
    while ((n = getchar()) != EOF) {
        while (n-- > 0 && (byte = getchar()) != EOF) {
            shagreen_receive(&receiver, (uint8_t)byte);
        }
        int n_ticks = getchar();
        for (int i = 0; i < n_ticks; i++) {
            put_sample(stdout, shagreen_tick(&receiver, (int16_t)(receiver.control.speed_dmmps & 0x7FFF)));
        }
        size_t len;
        while ((len = shagreen_transmit(&receiver, wire)) > 0) {
            putchar((int)len);
            fwrite(wire, 1, len, stdout);
        }
        putchar(0);
    }
    return 0;
}

static double now_secs(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int open_port(const char *name)
{
    struct termios t;
    int port = open(name, O_RDWR | O_NOCTTY | O_NONBLOCK);
    if (port < 0 || tcgetattr(port, &t) != 0) {
        return -1;
    }
    t.c_iflag = t.c_oflag = t.c_lflag = 0;
    t.c_cflag = CS8 | CREAD | CLOCAL;
    /* The highest baud rate that POSIX guarantees; pseudo terminals ignore it. */
    cfsetispeed(&t, B38400);
    cfsetospeed(&t, B38400);
    return tcsetattr(port, TCSANOW, &t) == 0 ? port : -1;
}

static int play_port(const char *name, const char *file, double secs)
{
    int port = open_port(name);
    FILE *out = fopen(file, "wb");
    if (port < 0 || out == NULL) {
        fprintf(stderr, "receiver: cannot open %s; check the path and your rights\n", port < 0 ? name : file);
        return 1;
    }
    const double begun = now_secs();
    double next = begun;
    while (now_secs() < begun + secs) {
        struct pollfd waits = {port, POLLIN, 0};
        uint8_t bytes[256], wire[SHAGREEN_MAX_WIRE];
        poll(&waits, 1, 1);
        ssize_t n = read(port, bytes, sizeof bytes);
        for (ssize_t i = 0; i < n; i++) {
            shagreen_receive(&receiver, bytes[i]);
        }
        const double now = now_secs();
        if (now - next > 0.1) { /* the computer was suspended */
            next = now;
            shagreen_skip(&receiver);
        }
        if (receiver.settings.config == 0) {
            next = now;
        }
        for (; next < now; next += 1.0 / receiver.settings.rate_hz) {
            put_sample(out, shagreen_tick(&receiver, 0));
        }
        size_t len;
        while ((len = shagreen_transmit(&receiver, wire)) > 0) {
            if (write(port, wire, len) < 0) {
                break; /* no room; the next status frame reports the current state */
            }
        }
    }
    fclose(out);
    close(port);
    return 0;
}

int main(int n_args, char **args)
{
    const shagreen_about about = {SHAGREEN_HAS_STREAM | SHAGREEN_HAS_CONTROL | SHAGREEN_HAS_FRICTION, 1000, 16000,
                                  "C receiver"};
    shagreen_init(&receiver, about);
    if (n_args == 4) {
        return play_port(args[1], args[2], atof(args[3]));
    }
    return play_steps();
}
