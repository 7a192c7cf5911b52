// Console program: prints the level of a runtime table while a tip strokes it at 0.1 m/s and 1 N.
//
//   dotnet run cork.shgt
//
// The library (libshagreen_runtime.so, libshagreen_runtime.dylib or shagreen_runtime.dll) lies beside the program.

using System;
using System.Globalization;
using System.IO;

namespace Shagreen
{
    internal static class Program
    {
        // Numbers with a point in every language.
        private static readonly CultureInfo Point = CultureInfo.InvariantCulture;

        private static int Main(string[] arguments)
        {
            if (arguments.Length != 1)
            {
                Console.Error.WriteLine("usage: dotnet run TABLE.shgt");
                return 1;
            }
            try
            {
                Play(arguments[0]);
                return 0;
            }
            catch (Exception error) when (error is IOException || error is InvalidOperationException || error is DllNotFoundException)
            {
                Console.Error.WriteLine(arguments[0] + ": " + error.Message);
                return 1;
            }
        }

        private static void Play(string table)
        {
            using (var texture = new Texture(File.ReadAllBytes(table)))
            using (var voice = new Voice(texture, 48000f, 500f, 7))
            {
                Console.WriteLine(texture.Name + ": " + texture.Info.n_nodes + " nodes, terms of use: " + texture.Terms);
                var samples = new float[480];
                var touch = new ShagreenTouch { speed_mps = 0.1f, force_n = 1f };
                double squares = 0;
                float frictionN = 0;
                for (int block = 0; block < 100; block++)
                {
                    touch.x_m += 0.1 * samples.Length / 48000;
                    Native.Check(voice.Process(ref touch, samples, samples.Length, out frictionN));
                    foreach (float sample in samples)
                    {
                        squares += sample * sample;
                    }
                }
                double level = Math.Sqrt(squares / (100 * samples.Length));
                Console.WriteLine(level.ToString("F3", Point) + " m/s², friction " + frictionN.ToString("F2", Point) + " N");
            }
        }
    }
}
