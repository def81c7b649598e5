import sys, Ice
