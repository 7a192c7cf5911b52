//! Saved choice of the networks that predict attributes from photos: an image network, and the heads that belong to it.
//!
//! ```json
//! {"network": "resnet-50", "file": "/networks/resnet50.safetensors", "heads": "/networks/heads.safetensors"}
//! ```
//!
//! `network` is `efficientnet-lite0`, `resnet-50` or `none`. `file` is that of ResNet-50. Without `heads`, the built-in
//! ones are used.

use std::path::PathBuf;

use serde::{Serialize, Serializer};
use serde_json::{Map, Value};

use crate::path_json;

/// Image network that computes the features of a photo.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ImageNetwork {
    /// EfficientNet-Lite0 in the folder of downloaded networks.
    EfficientnetLite0,
    /// ResNet-50 in a safetensors file at this path.
    Resnet50(PathBuf),
    /// None: the features are statistics of the picture.
    Statistics,
}

/// Networks that predict attributes from photos.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PhotoNetworks {
    /// The image network.
    pub network: ImageNetwork,
    /// File of the heads, the output networks on its features; `None` for built-in ones.
    pub heads: Option<PathBuf>,
}

impl PhotoNetworks {
    /// Returns the choice as JSON.
    pub fn to_json(&self) -> Value {
        let (name, file) = match &self.network {
            ImageNetwork::EfficientnetLite0 => ("efficientnet-lite0", None),
            ImageNetwork::Resnet50(file) => ("resnet-50", Some(file)),
            ImageNetwork::Statistics => ("none", None),
        };
        let mut fields = Map::from_iter([("network".to_owned(), Value::from(name))]);
        for (key, path) in [("file", file), ("heads", self.heads.as_ref())] {
            if let Some(path) = path {
                fields.insert(key.to_owned(), path_json::to_json(path));
            }
        }
        Value::Object(fields)
    }

    /// Returns the choice in JSON; `None` if it is none, or one of a later version.
    pub fn from_json(wire: &Value) -> Option<Self> {
        let path = |key: &str| wire.get(key).and_then(path_json::from_json);
        let network = match wire.get("network")?.as_str()? {
            "efficientnet-lite0" => ImageNetwork::EfficientnetLite0,
            "resnet-50" => ImageNetwork::Resnet50(path("file")?),
            "none" => ImageNetwork::Statistics,
            _ => return None,
        };
        Some(Self { network, heads: path("heads") })
    }
}

impl Serialize for PhotoNetworks {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.to_json().serialize(serializer)
    }
}

#[cfg(test)]
mod tests {
    use super::{ImageNetwork, PhotoNetworks};
    use serde_json::json;

    #[test]
    fn a_choice_comes_back_and_what_is_none_is_none() {
        let heads = Some("/h.safetensors".into());
        for networks in [
            PhotoNetworks { network: ImageNetwork::EfficientnetLite0, heads: None },
            PhotoNetworks { network: ImageNetwork::Resnet50("/r.safetensors".into()), heads },
            PhotoNetworks { network: ImageNetwork::Statistics, heads: None },
        ] {
            assert_eq!(PhotoNetworks::from_json(&networks.to_json()), Some(networks));
        }
        let written = PhotoNetworks { network: ImageNetwork::Statistics, heads: None }.to_json();
        assert_eq!(written, json!({"network": "none"}));
        for wrong in [json!(3), json!({}), json!({"network": "resnet-50"}), json!({"network": "later"})] {
            assert_eq!(PhotoNetworks::from_json(&wrong), None, "{wrong}");
        }
    }
}
