//! A recorded stroke, independent of its file format.

/// One report of a pen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PenSample {
    /// Time in seconds on any clock; never before that of the previous sample.
    pub time_secs: f64,
    /// Position to the right, in m.
    pub x_m: f64,
    /// Position away from the user, in m.
    pub y_m: f64,
    /// Pressure or force of the tip, in the unit of [`Stroke::Pen`].
    pub press: f64,
    /// Whether the tip is in contact.
    pub touching: bool,
    /// Speed towards the surface in m/s, non-negative, if known; it counts where a contact begins.
    pub impact_mps: Option<f64>,
}

/// Unit of [`PenSample::press`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PressUnit {
    /// Fraction of the pen's full scale, 0..1; needs a map to newtons.
    FullScale,
    /// Newtons.
    Newtons,
}

/// Speed and force at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimedContact {
    /// Time in seconds; later than that of the previous contact.
    pub time_secs: f64,
    /// Tangential speed in m/s, non-negative.
    pub speed_mps: f64,
    /// Normal force in N, non-negative; zero while the tip is lifted.
    pub force_n: f64,
    /// Speed towards the surface in m/s, non-negative, if known; it counts where a contact begins.
    pub impact_mps: Option<f64>,
}

impl TimedContact {
    /// Returns the impact speed in m/s of a contact that begins at this line of a table or on the way to the next one, if
    /// it is known: the higher value of the two lines if the contact begins between them, else that of this line.
    pub fn impact_mps_before(&self, next: &Self) -> Option<f64> {
        let begins_between = self.force_n == 0.0 && next.force_n > 0.0;
        let in_contact = next.impact_mps.filter(|_| begins_between);
        [self.impact_mps, in_contact].into_iter().flatten().reduce(f64::max)
    }

    /// Returns the landings of a table whose impact speed is known: time in s, after which the force is above zero, and impact
    /// speed in m/s. A first line in contact is a landing only if it states a speed above zero.
    pub fn known_impacts(contacts: &[Self]) -> Vec<(f64, f64)> {
        let first = contacts.first().filter(|first| first.force_n > 0.0);
        let known = |first: &Self| Some((first.time_secs, first.impact_mps.filter(|mps| *mps > 0.0)?));
        let at_start = first.and_then(known);
        let later = contacts.windows(2).filter_map(|pair| {
            let [from, to] = pair else { return None };
            let begins = from.force_n == 0.0 && to.force_n > 0.0;
            begins.then(|| from.impact_mps_before(to)).flatten().map(|mps| (from.time_secs, mps))
        });
        at_start.into_iter().chain(later).collect()
    }
}

/// A stroke.
#[derive(Clone, Debug, PartialEq)]
pub enum Stroke {
    /// Positions of a pen; its speed remains to be estimated.
    Pen {
        /// At least one sample.
        samples: Vec<PenSample>,
        /// Unit of the samples' `press`.
        press_unit: PressUnit,
    },
    /// Measured speed and force.
    Contacts(Vec<TimedContact>),
}

#[cfg(test)]
mod tests {
    use super::TimedContact;

    fn contact(time_secs: f64, force_n: f64, impact_mps: Option<f64>) -> TimedContact {
        TimedContact { time_secs, speed_mps: 0.0, force_n, impact_mps }
    }

    #[test]
    fn an_impact_belongs_to_the_contact_that_begins_there() {
        let [air, down] = [contact(0.0, 0.0, Some(0.1)), contact(1.0, 1.0, Some(0.3))];
        let unknown = TimedContact { impact_mps: None, ..air };
        assert_eq!(air.impact_mps_before(&down), Some(0.3));
        assert_eq!(air.impact_mps_before(&contact(1.0, 1.0, None)), Some(0.1));
        assert_eq!(unknown.impact_mps_before(&contact(1.0, 1.0, None)), None);
        // Neither a lift nor the next line of a contact has an impact.
        assert_eq!(contact(0.0, 1.0, None).impact_mps_before(&air), None);
        assert_eq!(contact(0.0, 1.0, None).impact_mps_before(&down), None);
    }

    #[test]
    fn known_impacts_are_those_of_landings() {
        let first = contact(0.0, 1.0, None);
        let rest = [
            contact(1.0, 1.0, Some(9.0)),
            contact(2.0, 0.0, None),
            contact(3.0, 1.0, Some(0.2)),
            contact(4.0, 0.0, None),
            contact(5.0, 1.0, None),
            contact(6.0, 0.0, Some(0.4)),
            contact(7.0, 1.0, Some(0.0)),
        ];
        let impacts = |first| TimedContact::known_impacts(&[&[first][..], &rest[..]].concat());
        assert_eq!(impacts(first), [(2.0, 0.2), (6.0, 0.4)]);
        assert_eq!(impacts(TimedContact { impact_mps: Some(0.0), ..first }), [(2.0, 0.2), (6.0, 0.4)]);
        let landed = impacts(TimedContact { impact_mps: Some(0.1), ..first });
        assert_eq!(landed, [(0.0, 0.1), (2.0, 0.2), (6.0, 0.4)]);
        assert_eq!(TimedContact::known_impacts(&[]), []);
    }
}
