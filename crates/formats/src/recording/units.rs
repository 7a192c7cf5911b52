//! Units of recording files.

/// Letters and digits of a unit in lower case. Spellings such as `m/s²`, `m/s^2`, `(m/s2)` and `m s⁻²` give the same
/// text or an alias.
pub(super) fn letters(text: &str) -> String {
    text.chars()
        .filter_map(|c| match c {
            '²' => Some('2'),
            'µ' | 'μ' => Some('u'),
            c if c.is_alphanumeric() => Some(c),
            _ => None,
        })
        .flat_map(char::to_lowercase)
        .collect()
}

macro_rules! unit {
    ($(#[$doc:meta])* $name:ident { $($(#[$unit_doc:meta])* $unit:ident: $text:literal, $si:expr, [$($alias:literal),*];)+ }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $name {
            $($(#[$unit_doc])* $unit,)+
        }

        impl $name {
            /// All units of this quantity.
            pub const ALL: &[Self] = &[$(Self::$unit),+];

            /// Name in a column map.
            pub fn name(self) -> &'static str {
                match self { $(Self::$unit => $text,)+ }
            }

            /// One unit, in the SI unit.
            pub fn si(self) -> f64 {
                match self { $(Self::$unit => $si,)+ }
            }

            /// Parses [`Self::name`] or another common spelling.
            pub fn parse(text: &str) -> Option<Self> {
                let text = letters(text);
                Self::ALL.iter().copied().find(|unit| match unit {
                    $(Self::$unit => text == letters($text) || [$($alias),*].contains(&text.as_str()),)+
                })
            }
        }
    };
}

unit!(
    /// A unit of time.
    TimeUnit {
        /// Seconds.
        Seconds: "s", 1.0, ["sec", "secs", "second", "seconds"];
        /// Milliseconds.
        Milliseconds: "ms", 1e-3, ["msec", "msecs", "millis", "millisecond", "milliseconds"];
        /// Microseconds.
        Microseconds: "us", 1e-6, ["usec", "usecs", "micros", "microsecond", "microseconds"];
        /// Nanoseconds.
        Nanoseconds: "ns", 1e-9, ["nsec", "nsecs", "nanos", "nanosecond", "nanoseconds"];
    }
);

unit!(
    /// A unit of acceleration.
    AccelerationUnit {
        /// Meters per second squared.
        MetersPerSecondSquared: "m/s^2", 1.0, ["mss", "mps2", "mpers2", "mpersec2", "ms2", "msec2"];
        /// Standard gravity, 9.80665 m/s².
        StandardGravity: "g", 9.806_65, ["gs", "g0", "gee", "gravity"];
        /// Thousandths of standard gravity.
        MilliGravity: "mg", 9.806_65e-3, ["millig"];
    }
);

unit!(
    /// A unit of speed.
    SpeedUnit {
        /// Millimeters per second.
        MillimetersPerSecond: "mm/s", 1e-3, ["mmps", "mmpers", "mmsec", "mmpersec"];
        /// Centimeters per second.
        CentimetersPerSecond: "cm/s", 1e-2, ["cmps", "cmpers", "cmsec", "cmpersec"];
        /// Meters per second.
        MetersPerSecond: "m/s", 1.0, ["mps", "mpers", "msec", "mpersec"];
    }
);

unit!(
    /// A unit of position.
    PositionUnit {
        /// Millimeters.
        Millimeters: "mm", 1e-3, ["millimeters", "millimetres"];
        /// Meters.
        Meters: "m", 1.0, ["meters", "metres"];
        /// Micrometers.
        Micrometers: "um", 1e-6, ["micrometers", "micrometres", "micron", "microns"];
    }
);

unit!(
    /// A unit of force.
    ForceUnit {
        /// Newtons.
        Newtons: "N", 1.0, ["newton", "newtons"];
        /// Millinewtons.
        Millinewtons: "mN", 1e-3, ["millinewton", "millinewtons"];
        /// Gram-force, 9.80665 mN.
        GramForce: "gf", 9.806_65e-3, ["g", "gram", "grams", "gramforce"];
    }
);
