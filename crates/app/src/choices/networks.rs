//! Image networks that predict attributes from photos.

/// Image network that computes the features of a photo.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NetworkChoice {
    /// The downloaded EfficientNet-Lite0.
    EfficientnetLite0,
    /// ResNet-50 in a file of the user.
    Resnet50,
    /// No network, but statistics of the picture.
    Statistics,
}

impl NetworkChoice {
    /// All choices, in the order of the list.
    pub const ALL: [Self; 3] = [Self::EfficientnetLite0, Self::Resnet50, Self::Statistics];
}
