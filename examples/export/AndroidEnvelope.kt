// Reads the file that `shagreen export --format android` writes, and makes vibration effects of Android 16 (API level 36).
//
// This file was never compiled: no Kotlin compiler was at hand. It uses the documented methods of VibrationEffect and Vibrator.
package shagreen

import android.os.VibrationEffect
import android.os.Vibrator
import android.os.vibrator.VibratorEnvelopeEffectInfo
import org.json.JSONArray
import org.json.JSONObject

// The two envelopes of a file, of which a device plays one.
class AndroidEnvelope(text: String) {
    private val file = JSONObject(text)

    init {
        require(file.getString("format") == "shagreen-android-envelope" && file.getString("version").startsWith("1.")) {
            "the file has another format; export it with --format android"
        }
    }

    // The waveform envelope in parts to play one after the other: a device limits the control points and the duration of an
    // effect, and each effect starts at amplitude 0. Frequencies outside the range of the device are moved to its ends, because
    // it would not play them. Null if the device has no envelopes, or does not state its frequencies.
    fun waveformParts(vibrator: Vibrator): List<VibrationEffect>? {
        if (!vibrator.areEnvelopeEffectsSupported()) return null
        val info = vibrator.envelopeEffectInfo ?: return null
        val profile = vibrator.frequencyProfile ?: return null
        val range = profile.minFrequencyHz..profile.maxFrequencyHz
        val waveform = file.getJSONObject("waveform")
        var frequencyHz = waveform.getDouble("initial_frequency_hz").toFloat().coerceIn(range)
        return parts(waveform.getJSONArray("points"), info).map { part ->
            val builder = VibrationEffect.WaveformEnvelopeBuilder().setInitialFrequencyHz(frequencyHz)
            for (point in part) {
                frequencyHz = point.getDouble("frequency_hz").toFloat().coerceIn(range)
                builder.addControlPoint(point.getDouble("amplitude").toFloat(), frequencyHz, point.getLong("duration_ms"))
            }
            builder.build()
        }
    }

    // The basic envelope in parts, for a device whose frequencies are not known. A part that ends above intensity 0 gets one more
    // point, since an effect of this kind must end at 0.
    fun basicParts(vibrator: Vibrator): List<VibrationEffect>? {
        if (!vibrator.areEnvelopeEffectsSupported()) return null
        val info = vibrator.envelopeEffectInfo ?: return null
        val basic = file.getJSONObject("basic")
        var sharpness = basic.getDouble("initial_sharpness").toFloat()
        return parts(basic.getJSONArray("points"), info).map { part ->
            val builder = VibrationEffect.BasicEnvelopeBuilder().setInitialSharpness(sharpness)
            for (point in part) {
                sharpness = point.getDouble("sharpness").toFloat()
                builder.addControlPoint(point.getDouble("intensity").toFloat(), sharpness, point.getLong("duration_ms"))
            }
            if (part.last().getDouble("intensity") > 0.0) {
                builder.addControlPoint(0f, sharpness, info.minControlPointDurationMillis)
            }
            builder.build()
        }
    }

    // Control points in parts within the limits of a device, with room for one more point each.
    private fun parts(points: JSONArray, info: VibratorEnvelopeEffectInfo): List<List<JSONObject>> {
        val most = (info.maxSize - 1).coerceAtLeast(1)
        val longestMs = info.maxDurationMillis - info.minControlPointDurationMillis
        val parts = mutableListOf<MutableList<JSONObject>>()
        var partMs = 0L
        for (index in 0 until points.length()) {
            val point = points.getJSONObject(index)
            val pointMs = point.getLong("duration_ms")
            val part = parts.lastOrNull()
            if (part == null || part.size == most || partMs + pointMs > longestMs) {
                parts.add(mutableListOf(point))
                partMs = pointMs
            } else {
                part.add(point)
                partMs += pointMs
            }
        }
        return parts
    }
}
