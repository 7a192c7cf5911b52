// Prints what a file of `shagreen export --format openxr` contains: one line for each call.
//
//   g++ -std=c++17 openxr_parametric_print.cpp -o print && ./print texture.openxr.json
#include <cstdio>
#include <exception>
#include <fstream>

#include "openxr_parametric.hpp"

int main(int argc, char **argv)
{
    if (argc != 2) {
        std::fprintf(stderr, "usage: %s FILE.openxr.json\n", argv[0]);
        return 2;
    }
    try {
        std::ifstream file(argv[1]);
        if (!file) {
            throw std::runtime_error("the file cannot be read");
        }
        const shagreen::Parametric parametric = shagreen::read_parametric(file);
        std::printf("%g to %g Hz\n", static_cast<double>(parametric.min_frequency_hz),
                    static_cast<double>(parametric.max_frequency_hz));
        for (const shagreen::Call &call : parametric.calls) {
            const double end_ms = call.amplitude.empty() ? 0.0 : 1e-6 * static_cast<double>(call.amplitude.back().time_ns);
            std::printf("frame %d: %zu amplitudes, %zu frequencies, %zu transients, to %g ms\n", static_cast<int>(call.frame),
                        call.amplitude.size(), call.frequency.size(), call.transients.size(), end_ms);
        }
    } catch (const std::exception &error) {
        std::fprintf(stderr, "%s: %s\n", argv[1], error.what());
        return 1;
    }
    return 0;
}
