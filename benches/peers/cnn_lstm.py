"""Peer of benches/cnn_lstm.rs: the CNN-LSTM stroke network in PyTorch and onnxruntime, on one core.

Usage: cnn_lstm.py INPUTS        prints one JSON line per measurement
       cnn_lstm.py --make INPUTS writes generated segments

The architecture is `literal` of crates/learn. A stream of six convolutions with two pooling layers and a stream of four
LSTM layers are concatenated and batch-normalized. Two dense layers lead to five attributes. The weights are PyTorch's
initial ones, as they do not affect the time.
"""
import os
import sys

import numpy as np

FILE = "cnnlstm_batch_32x200x5.f32"


def make(folder):
    np.random.default_rng(1).standard_normal((32, 200, 5)).astype("<f4").tofile(os.path.join(folder, FILE))


def main(folder):
    import torch
    from torch import nn

    from measure import bench

    torch.set_num_threads(1)
    torch.manual_seed(1)

    class Network(nn.Module):
        def __init__(self):
            super().__init__()
            layers, n = [], 3
            for index, (filters, kernel) in enumerate(zip((32, 64, 128, 128, 64, 32), (4, 4, 4, 3, 3, 3))):
                layers += [nn.Conv1d(n, filters, kernel), nn.ReLU()]
                if index in (1, 5):
                    layers.append(nn.MaxPool1d(2))
                n = filters
            self.convolutions = nn.Sequential(*layers, nn.Flatten())
            sizes = (3, 128, 256, 256, 128)
            self.memory = nn.ModuleList(nn.LSTM(a, b, batch_first=True) for a, b in zip(sizes, sizes[1:]))
            self.norm = nn.BatchNorm1d(32 * 44 + 128)
            self.head = nn.Sequential(
                nn.Linear(32 * 44 + 128, 128), nn.ReLU(), nn.Linear(128, 32), nn.ReLU(), nn.Linear(32, 5)
            )

        def forward(self, x):
            y = x
            for layer in self.memory:
                y = layer(y)[0]
            features = torch.cat([self.convolutions(x.transpose(1, 2)), y[:, -1]], 1)
            return self.head(self.norm(features))

    batch = np.fromfile(os.path.join(folder, FILE), "<f4").reshape(32, 200, 5)[:, :, :3].copy()
    batch = torch.from_numpy(batch)
    labels = torch.rand(32, 5)
    network = Network()
    adam = torch.optim.Adam(network.parameters(), 1e-3)

    def step():
        adam.zero_grad()
        loss = ((network(batch) - labels) ** 2).mean().sqrt()
        loss.backward()
        adam.step()

    training, inference = "CNN-LSTM, training step of 32 segments", "CNN-LSTM, inference of one segment"
    bench(training, f"PyTorch {torch.__version__}", 32, "segment", step)
    network.eval()
    one = batch[:1]
    with torch.inference_mode():
        bench(inference, f"PyTorch {torch.__version__}", 1, "segment", lambda: network(one))

    import onnxruntime

    path = os.path.join(folder, "cnn_lstm.onnx")
    torch.onnx.export(network, one, path, input_names=["x"], output_names=["y"], opset_version=17, dynamo=False)
    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = options.inter_op_num_threads = 1
    session = onnxruntime.InferenceSession(path, options, providers=["CPUExecutionProvider"])
    feed = {"x": one.numpy()}
    assert np.allclose(session.run(None, feed)[0], network(one).detach().numpy(), atol=1e-4)
    bench(inference, f"onnxruntime {onnxruntime.__version__}", 1, "segment", lambda: session.run(None, feed))


if __name__ == "__main__":
    (make if sys.argv[1] == "--make" else main)(sys.argv[-1])
