// Bindings to the library shagreen_runtime: the functions of crates/runtime-c/include/shagreen.h, and two classes that use
// them. Plain C# 7.3, for Unity and for .NET.
//
// Only Voice.Process and Voice.Tap may be called in an audio callback.

using System;
using System.Runtime.InteropServices;
using System.Text;
using Microsoft.Win32.SafeHandles;

namespace Shagreen
{
    /// <summary>Result of a function.</summary>
    public enum Status
    {
        Ok = 0,
        Pointer = 1,
        TooLong = 2,
        Foreign = 3,
        Version = 4,
        Incomplete = 5,
        Damaged = 6,
        Invalid = 7,
        Rate = 8,
        Limit = 9,
        Silenced = 10,
        Internal = 11,
    }

    /// <summary>Tip at one moment: position in m, speed in m/s, normal force in N.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct ShagreenTouch
    {
        public double x_m;
        public double y_m;
        public float speed_mps;
        public float force_n;
    }

    /// <summary>Numbers of a texture.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct ShagreenInfo
    {
        public ulong memory_bytes;
        public float rate_hz;
        public float speed_max_mps;
        public float force_max_n;
        public uint n_nodes;
        public uint n_triangles;
        public uint flags;
    }

    /// <summary>The functions of the library.</summary>
    internal static class Native
    {
        // On iOS, the library is linked into the program.
#if UNITY_IOS && !UNITY_EDITOR
        private const string Library = "__Internal";
#else
        private const string Library = "shagreen_runtime";
#endif

        internal const uint AbiVersion = 1;

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern uint shagreen_abi_version();

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern IntPtr shagreen_status_text(int status);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern Status shagreen_texture_load(byte[] bytes, UIntPtr n_bytes, out IntPtr texture);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern void shagreen_texture_destroy(IntPtr texture);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern Status shagreen_texture_info(TextureHandle texture, out ShagreenInfo info);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern IntPtr shagreen_texture_name(TextureHandle texture);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern IntPtr shagreen_texture_terms(TextureHandle texture);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern IntPtr shagreen_texture_origin(TextureHandle texture);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern UIntPtr shagreen_voice_size_bytes();

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern Status shagreen_voice_create(TextureHandle texture, float sample_rate_hz, float max_mps2, ulong seed, out IntPtr voice);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern void shagreen_voice_destroy(IntPtr voice);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern Status shagreen_voice_process(VoiceHandle voice, ref ShagreenTouch touches, UIntPtr n_touches, float[] samples, UIntPtr n_samples, out float friction_n);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern Status shagreen_voice_tap(VoiceHandle voice, float impact_mps);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern Status shagreen_voice_reset(VoiceHandle voice);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern float shagreen_voice_latency_secs(VoiceHandle voice);

        /// <summary>Text of the library, in UTF-8.</summary>
        internal static string Text(IntPtr text)
        {
            if (text == IntPtr.Zero)
            {
                return "";
            }
            int length = 0;
            while (Marshal.ReadByte(text, length) != 0)
            {
                length++;
            }
            var bytes = new byte[length];
            Marshal.Copy(text, bytes, 0, length);
            return Encoding.UTF8.GetString(bytes);
        }

        /// <summary>Throws unless a function has done its work.</summary>
        internal static void Check(Status status)
        {
            if (status != Status.Ok)
            {
                throw new InvalidOperationException("Shagreen: " + Text(shagreen_status_text((int)status)));
            }
        }
    }

    /// <summary>A texture of the library, freed when no call uses it any more.</summary>
    internal sealed class TextureHandle : SafeHandleZeroOrMinusOneIsInvalid
    {
        internal TextureHandle(IntPtr texture) : base(true)
        {
            SetHandle(texture);
        }

        protected override bool ReleaseHandle()
        {
            Native.shagreen_texture_destroy(handle);
            return true;
        }
    }

    /// <summary>A voice of the library, freed when no call uses it any more.</summary>
    internal sealed class VoiceHandle : SafeHandleZeroOrMinusOneIsInvalid
    {
        internal VoiceHandle(IntPtr voice) : base(true)
        {
            SetHandle(voice);
        }

        protected override bool ReleaseHandle()
        {
            Native.shagreen_voice_destroy(handle);
            return true;
        }
    }

    /// <summary>A texture in memory. Any number of threads may use it.</summary>
    public sealed class Texture : IDisposable
    {
        internal readonly TextureHandle handle;

        /// <summary>Loads the bytes of a runtime table (.shgt), which are not needed afterwards.</summary>
        public Texture(byte[] table)
        {
            if (Native.shagreen_abi_version() != Native.AbiVersion)
            {
                throw new InvalidOperationException("Shagreen: the library has another version than Shagreen.cs; update both");
            }
            IntPtr made;
            Native.Check(Native.shagreen_texture_load(table, new UIntPtr((uint)table.Length), out made));
            handle = new TextureHandle(made);
        }

        public ShagreenInfo Info
        {
            get
            {
                ShagreenInfo info;
                Native.Check(Native.shagreen_texture_info(handle, out info));
                return info;
            }
        }

        public string Name
        {
            get { return TextOf(Native.shagreen_texture_name(handle)); }
        }

        public string Terms
        {
            get { return TextOf(Native.shagreen_texture_terms(handle)); }
        }

        public string Origin
        {
            get { return TextOf(Native.shagreen_texture_origin(handle)); }
        }

        /// <summary>Frees the texture. Its voices stay valid.</summary>
        public void Dispose()
        {
            handle.Dispose();
        }

        private string TextOf(IntPtr text)
        {
            string copy = Native.Text(text);
            // The text is that of the texture, which must not be freed before.
            GC.KeepAlive(this);
            return copy;
        }
    }

    /// <summary>A texture under one tip. One thread at a time may use it.</summary>
    public sealed class Voice : IDisposable
    {
        private readonly VoiceHandle handle;

        /// <summary>Makes a voice. No sample is above maxMps2, in m/s².</summary>
        public Voice(Texture texture, float sampleRateHz, float maxMps2, ulong seed)
        {
            IntPtr made;
            Native.Check(Native.shagreen_voice_create(texture.handle, sampleRateHz, maxMps2, seed, out made));
            handle = new VoiceHandle(made);
        }

        /// <summary>Fills the samples in m/s². The touch is reached at the last one. Returns the friction force in N.</summary>
        public Status Process(ref ShagreenTouch touch, float[] samples, int nSamples, out float frictionN)
        {
            if (nSamples < 0 || nSamples > samples.Length)
            {
                throw new ArgumentOutOfRangeException("nSamples");
            }
            var n = new UIntPtr((uint)nSamples);
            return Native.shagreen_voice_process(handle, ref touch, new UIntPtr(1), samples, n, out frictionN);
        }

        /// <summary>Starts the tap transient with the next sample, for a landing at this speed in m/s.</summary>
        public Status Tap(float impactMps)
        {
            return Native.shagreen_voice_tap(handle, impactMps);
        }

        /// <summary>Returns to the state of a new voice.</summary>
        public void Reset()
        {
            Native.Check(Native.shagreen_voice_reset(handle));
        }

        /// <summary>Delay in s from a touch to the middle of its ramp in the samples.</summary>
        public float LatencySecs
        {
            get { return Native.shagreen_voice_latency_secs(handle); }
        }

        /// <summary>Frees the voice when no call uses it any more.</summary>
        public void Dispose()
        {
            handle.Dispose();
        }
    }
}
