"""Arrays and lists as NPY files, which NumPy reads back."""

import io
from array import array

import numpy
import pytest
from rastercheck import PictureError
from rastercheck._picture import to_npy


def read(picture):
    return numpy.load(io.BytesIO(to_npy(picture)), allow_pickle=False)


@pytest.mark.parametrize("kind", ["float32", "float16", "uint8", "uint16"])
@pytest.mark.parametrize("shape", [(2, 3), (2, 3, 4), (1, 1, 1)])
def test_arrays_come_back(kind, shape):
    picture = numpy.arange(numpy.prod(shape)).reshape(shape).astype(kind)
    for ours in (picture, picture[::-1], picture.swapaxes(0, 1), numpy.asfortranarray(picture)):
        again = read(ours)
        assert again.dtype == picture.dtype
        assert numpy.array_equal(again, ours)


def test_numbers_begin_where_numpy_has_them():
    assert to_npy(numpy.zeros((2, 3), "uint8"))[128:] == bytes(6)
    assert len(to_npy(numpy.zeros((16384, 2, 3), "uint8"))) % 64 == 0


def test_doubles_and_lists_are_rounded_once():
    doubles = numpy.array([[0.1, 1 + 2**-24, -0.0], [1e300, numpy.nan, 2**-149]])
    with numpy.errstate(over="ignore"):
        expected = doubles.astype(numpy.float32)
    for ours in (doubles, doubles.tolist()):
        assert read(ours).tobytes() == expected.tobytes()
    assert read([[(1, 2), (3, 4)]]).shape == (1, 2, 2)


def test_other_arrays_are_taken():
    class Tensor:
        def __array__(self):
            return numpy.ones((2, 2), numpy.float32)

    assert read(Tensor()).sum() == 4
    assert read(memoryview(array("f", [1, 2, 3, 4])).cast("B").cast("f", [2, 2])).sum() == 10


@pytest.mark.parametrize(
    "picture, message",
    [
        (numpy.zeros(3, "float32"), "a picture has 2 axes .* this array has 1"),
        (numpy.zeros((2, 2), "int64"), "this array holds numbers of the format 'l'"),
        (numpy.zeros((2, 2), ">f4"), "this array holds numbers of the format '>f'"),
        ([1, 2], r"this is a list of the shape \(2,\)"),
        ([], r"this is a list of the shape \(0,\)"),
        (None, "this is a NoneType of the shape"),
        ([[1, 2], [3]], r"the list at \[1\] does not have 2 entries"),
        ([[1], ["a"]], "a picture holds numbers: "),
    ],
)
def test_what_is_no_picture_is_refused(picture, message):
    with pytest.raises(PictureError, match=message):
        to_npy(picture)
