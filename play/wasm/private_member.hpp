#pragma once

// Reaches private members of the library's structures, which the page draws and no program needs. An explicit
// instantiation may name a private member ([temp.spec.general]), and its friend function returns it:
//
//    ABUT_PLAY_PRIVATE(CellsOfGrid, Grid<2>::cells_)
//    grid.*member_of(CellsOfGrid())

namespace abut::play {

template <class Name, auto member>
struct PrivateMember {
    friend constexpr auto member_of(Name) { return member; }
};

}  // namespace abut::play

#define ABUT_PLAY_PRIVATE(name, member)        \
    struct name {                              \
        friend constexpr auto member_of(name); \
    };                                         \
    template struct PrivateMember<name, &member>;
