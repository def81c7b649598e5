include "recursive.thrift"
struct Tree { 1: list<Tree> children }
typedef A B
typedef B A
service First extends Second { }
service Second extends First { }
/* no end
