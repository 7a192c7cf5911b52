// Reads the file that `shagreen export --format openxr` writes, and plays it by the extension XR_EXT_haptic_parametric.
//
// C++17, no other library. Include <openxr/openxr.h> before this file for `shagreen::play`; without it, only the reader is
// compiled. An error throws std::runtime_error with a sentence about it.
#pragma once

#include <cctype>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <istream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace shagreen {

// Point of amplitude or frequency: ns from the start of the first call, and a value from 0 to 1.
struct Point {
    std::int64_t time_ns;
    float value;
};

// Short event.
struct Transient {
    std::int64_t time_ns;
    float amplitude;
    float frequency;
};

// Place of a call in a stream, with the numbers of XrHapticParametricStreamFrameTypeEXT.
enum class Frame { none = 0, first = 1, intermediate = 2, last = 3 };

struct Call {
    Frame frame;
    std::vector<Point> amplitude;
    std::vector<Point> frequency;
    std::vector<Transient> transients;
};

struct Parametric {
    float min_frequency_hz;
    float max_frequency_hz;
    std::vector<Call> calls;
};

namespace json {

// A JSON value. Texts have no escapes but those of ASCII characters, which is enough for the fields that are read.
struct Value {
    enum class Kind { other, number, text, list, object };
    Kind kind = Kind::other;
    double number = 0.0;
    std::string text;
    std::vector<Value> list;
    std::map<std::string, Value> object;

    const Value &at(const std::string &name) const
    {
        auto found = object.find(name);
        if (found == object.end()) {
            throw std::runtime_error("the field \"" + name + "\" is missing; export the file again");
        }
        return found->second;
    }
};

class Reader {
public:
    explicit Reader(const std::string &text) : text_(text) {}

    Value whole()
    {
        Value value = any(0);
        space();
        if (place_ != text_.size()) {
            fail();
        }
        return value;
    }

private:
    const std::string &text_;
    std::size_t place_ = 0;

    [[noreturn]] void fail() const
    {
        throw std::runtime_error("the file is damaged at byte " + std::to_string(place_) + "; export it again");
    }

    void space()
    {
        while (place_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[place_]))) {
            place_++;
        }
    }

    bool takes(char wanted)
    {
        space();
        if (place_ < text_.size() && text_[place_] == wanted) {
            place_++;
            return true;
        }
        return false;
    }

    std::string quoted()
    {
        std::string out;
        while (place_ < text_.size() && text_[place_] != '"') {
            if (text_[place_] == '\\' && ++place_ >= text_.size()) {
                fail();
            }
            out += text_[place_++];
        }
        if (!takes('"')) {
            fail();
        }
        return out;
    }

    Value any(int depth)
    {
        if (depth > 16) {
            fail();
        }
        Value value;
        if (takes('{')) {
            value.kind = Value::Kind::object;
            if (!takes('}')) {
                do {
                    if (!takes('"')) {
                        fail();
                    }
                    std::string name = quoted();
                    if (!takes(':')) {
                        fail();
                    }
                    value.object[name] = any(depth + 1);
                } while (takes(','));
                if (!takes('}')) {
                    fail();
                }
            }
        } else if (takes('[')) {
            value.kind = Value::Kind::list;
            if (!takes(']')) {
                do {
                    value.list.push_back(any(depth + 1));
                } while (takes(','));
                if (!takes(']')) {
                    fail();
                }
            }
        } else if (takes('"')) {
            value.kind = Value::Kind::text;
            value.text = quoted();
        } else {
            scalar(value);
        }
        return value;
    }

    void scalar(Value &value)
    {
        for (const char *word : {"true", "false", "null"}) {
            std::string wanted = word;
            if (text_.compare(place_, wanted.size(), wanted) == 0) {
                place_ += wanted.size();
                return;
            }
        }
        const char *begin = text_.c_str() + place_;
        char *end = nullptr;
        value.kind = Value::Kind::number;
        value.number = std::strtod(begin, &end);
        if (end == begin) {
            fail();
        }
        place_ += static_cast<std::size_t>(end - begin);
    }
};

} // namespace json

inline std::int64_t time_of(const json::Value &value)
{
    return static_cast<std::int64_t>(value.at("time_ns").number);
}

inline float number_of(const json::Value &value, const char *name)
{
    return static_cast<float>(value.at(name).number);
}

inline std::vector<Point> points_of(const json::Value &list)
{
    std::vector<Point> points;
    for (const json::Value &point : list.list) {
        points.push_back({time_of(point), number_of(point, "value")});
    }
    return points;
}

inline Frame frame_of(const std::string &name)
{
    const std::map<std::string, Frame> frames = {{"none", Frame::none},
                                                 {"first", Frame::first},
                                                 {"intermediate", Frame::intermediate},
                                                 {"last", Frame::last}};
    auto found = frames.find(name);
    if (found == frames.end()) {
        throw std::runtime_error("the frame \"" + name + "\" is unknown; use a newer version of this reader");
    }
    return found->second;
}

// Reads a file.
inline Parametric read_parametric(std::istream &in)
{
    const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    const json::Value file = json::Reader(text).whole();
    if (file.at("format").text != "shagreen-openxr-parametric" || file.at("version").text.rfind("1.", 0) != 0) {
        throw std::runtime_error("the file has another format; export it with --format openxr");
    }
    Parametric parametric{number_of(file, "min_frequency_hz"), number_of(file, "max_frequency_hz"), {}};
    for (const json::Value &call : file.at("calls").list) {
        std::vector<Transient> transients;
        for (const json::Value &one : call.at("transients").list) {
            transients.push_back({time_of(one), number_of(one, "amplitude"), number_of(one, "frequency")});
        }
        parametric.calls.push_back({frame_of(call.at("frame").text), points_of(call.at("amplitude")),
                                    points_of(call.at("frequency")), transients});
    }
    return parametric;
}

#ifdef XR_EXT_haptic_parametric

// Plays one call. The frequencies in Hz belong to the first call of a stream only. Later calls must follow before the points of
// the one before have played; xrHapticParametricGetPropertiesEXT states how often.
inline XrResult play(XrSession session, const XrHapticActionInfo &info, const Parametric &parametric, std::size_t index)
{
    const Call &call = parametric.calls.at(index);
    std::vector<XrHapticParametricPointEXT> amplitude, frequency;
    std::vector<XrHapticParametricTransientEXT> transients;
    for (const Point &point : call.amplitude) {
        amplitude.push_back({point.time_ns, point.value});
    }
    for (const Point &point : call.frequency) {
        frequency.push_back({point.time_ns, point.value});
    }
    for (const Transient &one : call.transients) {
        transients.push_back({one.time_ns, one.amplitude, one.frequency});
    }
    XrHapticParametricVibrationEXT vibration{};
    vibration.type = XR_TYPE_HAPTIC_PARAMETRIC_VIBRATION_EXT;
    vibration.amplitudePointCount = static_cast<uint32_t>(amplitude.size());
    vibration.amplitudePoints = amplitude.data();
    vibration.frequencyPointCount = static_cast<uint32_t>(frequency.size());
    vibration.frequencyPoints = frequency.data();
    vibration.transientCount = static_cast<uint32_t>(transients.size());
    vibration.transients = transients.data();
    const bool starts = call.frame == Frame::none || call.frame == Frame::first;
    vibration.minFrequencyHz = starts ? parametric.min_frequency_hz : XR_FREQUENCY_UNSPECIFIED;
    vibration.maxFrequencyHz = starts ? parametric.max_frequency_hz : XR_FREQUENCY_UNSPECIFIED;
    vibration.streamFrameType = static_cast<XrHapticParametricStreamFrameTypeEXT>(call.frame);
    return xrApplyHapticFeedback(session, &info, reinterpret_cast<const XrHapticBaseHeader *>(&vibration));
}

#endif

} // namespace shagreen
