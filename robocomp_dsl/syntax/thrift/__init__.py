"""Thrift definitions: `.thrift` files, as yarpidl_thrift of YARP reads them."""
