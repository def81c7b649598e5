from specificworker import *
