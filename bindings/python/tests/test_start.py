# SPDX-License-Identifier: Apache-2.0
import asperity


def test_it_is_there():
    assert asperity.__version__ == "0.1.0"
