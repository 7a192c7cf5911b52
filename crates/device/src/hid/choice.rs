//! Choice of the pen to read: the one with an id, or automatically the one that provides most.

use std::cmp::Reverse;

use crate::error::{DeviceError, DeviceErrorKind};
use crate::hid::identity::{HidPen, denied};
use crate::pen_backend::{Access, PositionUnit};

/// Id that selects the pen that provides most: see [`best`].
pub const AUTOMATIC_ID: &str = "auto";

/// The pen that provides most, of those that this program may open: position in mm first, then pressure, a clock of its
/// own and tilt. HID is preferred to Raw Input. What is unknown counts less than what is known to be provided.
pub fn best(pens: &[HidPen]) -> Option<&HidPen> {
    let rank = |known: Option<bool>| match known {
        Some(true) => 2,
        None => 1,
        Some(false) => 0,
    };
    let key = |pen: &&HidPen| {
        let provides = pen.provides;
        let is_in_mm = provides.position.map(|unit| unit == PositionUnit::Millimeters);
        let quantities = [is_in_mm, provides.pressure, provides.clock, provides.tilt].map(rank);
        (pen.access == Access::Granted, quantities, Reverse(pen.backend), Reverse(pen.id.clone()))
    };
    pens.iter().filter(|pen| pen.access.may_open()).max_by_key(key)
}

/// The pen with this id, or [`best`] for [`AUTOMATIC_ID`].
///
/// # Errors
/// - [`DeviceErrorKind::NotFound`] if it is not connected.
/// - [`DeviceErrorKind::Denied`] if the system permits to read none of the connected pens.
pub(crate) fn chosen(pens: Vec<HidPen>, id: &str) -> Result<HidPen, DeviceError> {
    if id == AUTOMATIC_ID {
        return match (best(&pens), pens.first()) {
            (Some(pen), _) => Ok(pen.clone()),
            (None, Some(pen)) => Err(denied(pen)),
            (None, None) => Err(DeviceError::new(
                DeviceErrorKind::NotFound,
                "no pen is connected; plug one in, or use the mouse",
            )),
        };
    }
    pens.into_iter().find(|pen| pen.id == id).ok_or_else(|| {
        let message = format!("the pen {id} is not connected; plug it in, or choose another");
        DeviceError::new(DeviceErrorKind::NotFound, message)
    })
}

#[cfg(test)]
mod tests {
    use super::{AUTOMATIC_ID, Access, DeviceErrorKind, HidPen, PositionUnit, best, chosen};
    use crate::hid::identity::HidBus;
    use crate::pen_backend::{Backend, Provides};

    fn pen(id: &str, backend: Backend, access: Access, provides: Provides) -> HidPen {
        HidPen {
            id: id.to_owned(),
            name: format!("Pen {id}"),
            vendor_id: 1,
            product_id: 2,
            serial: None,
            interface: None,
            path: format!("/dev/{id}"),
            bus: HidBus::Usb,
            backend,
            provides,
            access,
        }
    }

    const WHOLE: Provides = Provides {
        position: Some(PositionUnit::Millimeters),
        pressure: Some(true),
        tilt: Some(false),
        clock: Some(false),
    };

    #[track_caller]
    fn check(pens: &[HidPen], expected: Option<&str>) {
        assert_eq!(best(pens).map(|pen| pen.id.as_str()), expected);
        let mut turned = pens.to_vec();
        turned.reverse();
        assert_eq!(
            best(&turned).map(|pen| pen.id.as_str()),
            expected,
            "the order of the list does not matter"
        );
    }

    #[test]
    fn the_pen_that_provides_most_is_chosen_among_those_that_may_be_read() {
        let hid = |id, access, provides| pen(id, Backend::Hid, access, provides);
        check(&[], None);
        let weak = Provides { pressure: Some(false), ..WHOLE };
        let sizeless = Provides { position: Some(PositionUnit::Fraction), ..WHOLE };
        let tilted = Provides { tilt: Some(true), ..WHOLE };
        let whole = hid("whole", Access::Granted, WHOLE);
        check(&[whole.clone(), hid("weak", Access::Granted, weak)], Some("whole"));
        check(&[whole.clone(), hid("sizeless", Access::Granted, sizeless)], Some("whole"));
        check(&[whole.clone(), hid("tilted", Access::Granted, tilted)], Some("tilted"));
        check(&[whole.clone(), hid("unknown", Access::Granted, Provides::UNKNOWN)], Some("whole"));
        // Permission comes first.
        check(&[whole.clone(), hid("tilted", Access::Unknown, tilted)], Some("whole"));
        check(&[whole.clone(), hid("tilted", Access::Denied, tilted)], Some("whole"));
        check(&[hid("tilted", Access::Denied, tilted)], None);
        // Windows opens the pen itself, but passes on its reports.
        let raw = pen("raw", Backend::RawInput, Access::Granted, WHOLE);
        check(&[hid("kept", Access::Exclusive, tilted), raw.clone()], Some("raw"));
        check(&[raw, whole], Some("whole"));
    }

    #[test]
    fn what_cannot_be_chosen_says_why() {
        let pens = vec![pen("a", Backend::Hid, Access::Denied, WHOLE)];
        assert_eq!(chosen(pens.clone(), "a").unwrap().id, "a", "whoever names a pen may try it");
        assert_eq!(chosen(pens.clone(), "b").unwrap_err().kind(), DeviceErrorKind::NotFound);
        assert_eq!(chosen(pens, AUTOMATIC_ID).unwrap_err().kind(), DeviceErrorKind::Denied);
        let none = chosen(Vec::new(), AUTOMATIC_ID).unwrap_err();
        assert_eq!(none.kind(), DeviceErrorKind::NotFound);
        assert!(none.message().contains("no pen is connected"));
    }
}
