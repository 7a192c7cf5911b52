// Unity component: plays a runtime table on the AudioSource of its object, for an actuator on an audio output.
//
// Export a table into Assets/StreamingAssets, copy the library into Assets/Plugins, and add this component to an object with an
// AudioSource. Call Touch from the script that moves the tip.

using System.IO;
using System.Threading;
using UnityEngine;

namespace Shagreen
{
    [RequireComponent(typeof(AudioSource))]
    public sealed class ShagreenSource : MonoBehaviour
    {
        [Tooltip("File in Assets/StreamingAssets.")]
        public string table = "cork.shgt";

        [Tooltip("Acceleration in m/s² at full scale of the output, and highest acceleration.")]
        public float fullScaleMps2 = 50f;

        [Tooltip("Seed of the noise.")]
        public uint seed = 1;

        /// <summary>Kinetic friction force in N, for a device that renders forces.</summary>
        public float FrictionN
        {
            get { return Volatile.Read(ref frictionN); }
        }

        // The audio thread reads the newest touch. The others have time to be read to their end.
        private readonly ShagreenTouch[] touches = new ShagreenTouch[8];
        private int newest;
        private int landings;
        private int landingsPlayed;
        private float impactMps;
        private float frictionN;
        private float[] samples = new float[4096];
        private Texture texture;
        private Voice voice;

        private void OnEnable()
        {
            byte[] bytes = File.ReadAllBytes(Path.Combine(Application.streamingAssetsPath, table));
            texture = new Texture(bytes);
            Volatile.Write(ref voice, new Voice(texture, AudioSettings.outputSampleRate, fullScaleMps2, seed));
        }

        private void OnDisable()
        {
            Voice playing = Volatile.Read(ref voice);
            Volatile.Write(ref voice, null);
            // A callback that still uses the voice ends before it is freed.
            playing?.Dispose();
            texture?.Dispose();
        }

        /// <summary>Sets position in m, speed in m/s and normal force in N of the tip; a force of 0 lifts it.</summary>
        public void Touch(Vector2 positionM, float speedMps, float forceN)
        {
            bool lands = forceN > 0f && !(touches[newest].force_n > 0f);
            int next = (newest + 1) % touches.Length;
            touches[next].x_m = positionM.x;
            touches[next].y_m = positionM.y;
            touches[next].speed_mps = speedMps;
            touches[next].force_n = forceN;
            Volatile.Write(ref newest, next);
            if (lands)
            {
                Land(0.1f);
            }
        }

        /// <summary>Plays the tap transient of a landing at this speed in m/s.</summary>
        public void Land(float speedMps)
        {
            Volatile.Write(ref impactMps, speedMps);
            Volatile.Write(ref landings, landings + 1);
        }

        // Runs in the audio thread.
        private void OnAudioFilterRead(float[] data, int channels)
        {
            Voice playing = Volatile.Read(ref voice);
            int frames = data.Length / channels;
            if (playing == null || frames > samples.Length)
            {
                return;
            }
            int landed = Volatile.Read(ref landings);
            bool strikes = landed != landingsPlayed;
            landingsPlayed = landed;
            ShagreenTouch touch = touches[Volatile.Read(ref newest)];
            float friction;
            try
            {
                if (strikes)
                {
                    playing.Tap(Volatile.Read(ref impactMps));
                }
                playing.Process(ref touch, samples, frames, out friction);
            }
            catch (System.ObjectDisposedException)
            {
                return;
            }
            Volatile.Write(ref frictionN, friction);
            for (int frame = 0; frame < frames; frame++)
            {
                float sample = samples[frame] / fullScaleMps2;
                for (int channel = 0; channel < channels; channel++)
                {
                    data[frame * channels + channel] = sample;
                }
            }
        }
    }
}
