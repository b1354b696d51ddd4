// SPDX-License-Identifier: BSD-3-Clause
// Written by catena-derive. Do not edit: change the model description and derive again.
#include "chain_60.hpp"

#include "catena_model.h"
#include "directions.hpp"

namespace catena::chain_60 {

namespace {

static const catena_quantity kCoordinateTable[] = {
    {"theta_1", "rad"},
    {"theta_2", "rad"},
    {"theta_3", "rad"},
    {"theta_4", "rad"},
    {"theta_5", "rad"},
    {"theta_6", "rad"},
    {"theta_7", "rad"},
    {"theta_8", "rad"},
    {"theta_9", "rad"},
    {"theta_10", "rad"},
    {"theta_11", "rad"},
    {"theta_12", "rad"},
    {"theta_13", "rad"},
    {"theta_14", "rad"},
    {"theta_15", "rad"},
    {"theta_16", "rad"},
    {"theta_17", "rad"},
    {"theta_18", "rad"},
    {"theta_19", "rad"},
    {"theta_20", "rad"},
    {"theta_21", "rad"},
    {"theta_22", "rad"},
    {"theta_23", "rad"},
    {"theta_24", "rad"},
    {"theta_25", "rad"},
    {"theta_26", "rad"},
    {"theta_27", "rad"},
    {"theta_28", "rad"},
    {"theta_29", "rad"},
    {"theta_30", "rad"},
    {"theta_31", "rad"},
    {"theta_32", "rad"},
    {"theta_33", "rad"},
    {"theta_34", "rad"},
    {"theta_35", "rad"},
    {"theta_36", "rad"},
    {"theta_37", "rad"},
    {"theta_38", "rad"},
    {"theta_39", "rad"},
    {"theta_40", "rad"},
    {"theta_41", "rad"},
    {"theta_42", "rad"},
    {"theta_43", "rad"},
    {"theta_44", "rad"},
    {"theta_45", "rad"},
    {"theta_46", "rad"},
    {"theta_47", "rad"},
    {"theta_48", "rad"},
    {"theta_49", "rad"},
    {"theta_50", "rad"},
    {"theta_51", "rad"},
    {"theta_52", "rad"},
    {"theta_53", "rad"},
    {"theta_54", "rad"},
    {"theta_55", "rad"},
    {"theta_56", "rad"},
    {"theta_57", "rad"},
    {"theta_58", "rad"},
    {"theta_59", "rad"},
    {"theta_60", "rad"},
};

static const catena_quantity kStateTable[] = {
    {0, 0},
};

static const catena_quantity kSignalTable[] = {
    {0, 0},
};

static const catena_quantity kTermTable[] = {
    {"inertia", "N m"},
    {"coriolis", "N m"},
    {"gravity", "N m"},
    {"elastic", "N m"},
    {"friction", "N m"},
    {"torque", "N m"},
};

static const catena_parameter kParameterTable[] = {
    {"length_1", "m", "length of link 1", NAN, 0.0, INFINITY, NAN},
    {"length_2", "m", "length of link 2", NAN, 0.0, INFINITY, NAN},
    {"length_3", "m", "length of link 3", NAN, 0.0, INFINITY, NAN},
    {"length_4", "m", "length of link 4", NAN, 0.0, INFINITY, NAN},
    {"length_5", "m", "length of link 5", NAN, 0.0, INFINITY, NAN},
    {"length_6", "m", "length of link 6", NAN, 0.0, INFINITY, NAN},
    {"length_7", "m", "length of link 7", NAN, 0.0, INFINITY, NAN},
    {"length_8", "m", "length of link 8", NAN, 0.0, INFINITY, NAN},
    {"length_9", "m", "length of link 9", NAN, 0.0, INFINITY, NAN},
    {"length_10", "m", "length of link 10", NAN, 0.0, INFINITY, NAN},
    {"length_11", "m", "length of link 11", NAN, 0.0, INFINITY, NAN},
    {"length_12", "m", "length of link 12", NAN, 0.0, INFINITY, NAN},
    {"length_13", "m", "length of link 13", NAN, 0.0, INFINITY, NAN},
    {"length_14", "m", "length of link 14", NAN, 0.0, INFINITY, NAN},
    {"length_15", "m", "length of link 15", NAN, 0.0, INFINITY, NAN},
    {"length_16", "m", "length of link 16", NAN, 0.0, INFINITY, NAN},
    {"length_17", "m", "length of link 17", NAN, 0.0, INFINITY, NAN},
    {"length_18", "m", "length of link 18", NAN, 0.0, INFINITY, NAN},
    {"length_19", "m", "length of link 19", NAN, 0.0, INFINITY, NAN},
    {"length_20", "m", "length of link 20", NAN, 0.0, INFINITY, NAN},
    {"length_21", "m", "length of link 21", NAN, 0.0, INFINITY, NAN},
    {"length_22", "m", "length of link 22", NAN, 0.0, INFINITY, NAN},
    {"length_23", "m", "length of link 23", NAN, 0.0, INFINITY, NAN},
    {"length_24", "m", "length of link 24", NAN, 0.0, INFINITY, NAN},
    {"length_25", "m", "length of link 25", NAN, 0.0, INFINITY, NAN},
    {"length_26", "m", "length of link 26", NAN, 0.0, INFINITY, NAN},
    {"length_27", "m", "length of link 27", NAN, 0.0, INFINITY, NAN},
    {"length_28", "m", "length of link 28", NAN, 0.0, INFINITY, NAN},
    {"length_29", "m", "length of link 29", NAN, 0.0, INFINITY, NAN},
    {"length_30", "m", "length of link 30", NAN, 0.0, INFINITY, NAN},
    {"length_31", "m", "length of link 31", NAN, 0.0, INFINITY, NAN},
    {"length_32", "m", "length of link 32", NAN, 0.0, INFINITY, NAN},
    {"length_33", "m", "length of link 33", NAN, 0.0, INFINITY, NAN},
    {"length_34", "m", "length of link 34", NAN, 0.0, INFINITY, NAN},
    {"length_35", "m", "length of link 35", NAN, 0.0, INFINITY, NAN},
    {"length_36", "m", "length of link 36", NAN, 0.0, INFINITY, NAN},
    {"length_37", "m", "length of link 37", NAN, 0.0, INFINITY, NAN},
    {"length_38", "m", "length of link 38", NAN, 0.0, INFINITY, NAN},
    {"length_39", "m", "length of link 39", NAN, 0.0, INFINITY, NAN},
    {"length_40", "m", "length of link 40", NAN, 0.0, INFINITY, NAN},
    {"length_41", "m", "length of link 41", NAN, 0.0, INFINITY, NAN},
    {"length_42", "m", "length of link 42", NAN, 0.0, INFINITY, NAN},
    {"length_43", "m", "length of link 43", NAN, 0.0, INFINITY, NAN},
    {"length_44", "m", "length of link 44", NAN, 0.0, INFINITY, NAN},
    {"length_45", "m", "length of link 45", NAN, 0.0, INFINITY, NAN},
    {"length_46", "m", "length of link 46", NAN, 0.0, INFINITY, NAN},
    {"length_47", "m", "length of link 47", NAN, 0.0, INFINITY, NAN},
    {"length_48", "m", "length of link 48", NAN, 0.0, INFINITY, NAN},
    {"length_49", "m", "length of link 49", NAN, 0.0, INFINITY, NAN},
    {"length_50", "m", "length of link 50", NAN, 0.0, INFINITY, NAN},
    {"length_51", "m", "length of link 51", NAN, 0.0, INFINITY, NAN},
    {"length_52", "m", "length of link 52", NAN, 0.0, INFINITY, NAN},
    {"length_53", "m", "length of link 53", NAN, 0.0, INFINITY, NAN},
    {"length_54", "m", "length of link 54", NAN, 0.0, INFINITY, NAN},
    {"length_55", "m", "length of link 55", NAN, 0.0, INFINITY, NAN},
    {"length_56", "m", "length of link 56", NAN, 0.0, INFINITY, NAN},
    {"length_57", "m", "length of link 57", NAN, 0.0, INFINITY, NAN},
    {"length_58", "m", "length of link 58", NAN, 0.0, INFINITY, NAN},
    {"length_59", "m", "length of link 59", NAN, 0.0, INFINITY, NAN},
    {"length_60", "m", "length of link 60", NAN, 0.0, INFINITY, NAN},
    {"mass_1", "kg", "mass of link 1", NAN, 0.0, INFINITY, NAN},
    {"mass_2", "kg", "mass of link 2", NAN, 0.0, INFINITY, NAN},
    {"mass_3", "kg", "mass of link 3", NAN, 0.0, INFINITY, NAN},
    {"mass_4", "kg", "mass of link 4", NAN, 0.0, INFINITY, NAN},
    {"mass_5", "kg", "mass of link 5", NAN, 0.0, INFINITY, NAN},
    {"mass_6", "kg", "mass of link 6", NAN, 0.0, INFINITY, NAN},
    {"mass_7", "kg", "mass of link 7", NAN, 0.0, INFINITY, NAN},
    {"mass_8", "kg", "mass of link 8", NAN, 0.0, INFINITY, NAN},
    {"mass_9", "kg", "mass of link 9", NAN, 0.0, INFINITY, NAN},
    {"mass_10", "kg", "mass of link 10", NAN, 0.0, INFINITY, NAN},
    {"mass_11", "kg", "mass of link 11", NAN, 0.0, INFINITY, NAN},
    {"mass_12", "kg", "mass of link 12", NAN, 0.0, INFINITY, NAN},
    {"mass_13", "kg", "mass of link 13", NAN, 0.0, INFINITY, NAN},
    {"mass_14", "kg", "mass of link 14", NAN, 0.0, INFINITY, NAN},
    {"mass_15", "kg", "mass of link 15", NAN, 0.0, INFINITY, NAN},
    {"mass_16", "kg", "mass of link 16", NAN, 0.0, INFINITY, NAN},
    {"mass_17", "kg", "mass of link 17", NAN, 0.0, INFINITY, NAN},
    {"mass_18", "kg", "mass of link 18", NAN, 0.0, INFINITY, NAN},
    {"mass_19", "kg", "mass of link 19", NAN, 0.0, INFINITY, NAN},
    {"mass_20", "kg", "mass of link 20", NAN, 0.0, INFINITY, NAN},
    {"mass_21", "kg", "mass of link 21", NAN, 0.0, INFINITY, NAN},
    {"mass_22", "kg", "mass of link 22", NAN, 0.0, INFINITY, NAN},
    {"mass_23", "kg", "mass of link 23", NAN, 0.0, INFINITY, NAN},
    {"mass_24", "kg", "mass of link 24", NAN, 0.0, INFINITY, NAN},
    {"mass_25", "kg", "mass of link 25", NAN, 0.0, INFINITY, NAN},
    {"mass_26", "kg", "mass of link 26", NAN, 0.0, INFINITY, NAN},
    {"mass_27", "kg", "mass of link 27", NAN, 0.0, INFINITY, NAN},
    {"mass_28", "kg", "mass of link 28", NAN, 0.0, INFINITY, NAN},
    {"mass_29", "kg", "mass of link 29", NAN, 0.0, INFINITY, NAN},
    {"mass_30", "kg", "mass of link 30", NAN, 0.0, INFINITY, NAN},
    {"mass_31", "kg", "mass of link 31", NAN, 0.0, INFINITY, NAN},
    {"mass_32", "kg", "mass of link 32", NAN, 0.0, INFINITY, NAN},
    {"mass_33", "kg", "mass of link 33", NAN, 0.0, INFINITY, NAN},
    {"mass_34", "kg", "mass of link 34", NAN, 0.0, INFINITY, NAN},
    {"mass_35", "kg", "mass of link 35", NAN, 0.0, INFINITY, NAN},
    {"mass_36", "kg", "mass of link 36", NAN, 0.0, INFINITY, NAN},
    {"mass_37", "kg", "mass of link 37", NAN, 0.0, INFINITY, NAN},
    {"mass_38", "kg", "mass of link 38", NAN, 0.0, INFINITY, NAN},
    {"mass_39", "kg", "mass of link 39", NAN, 0.0, INFINITY, NAN},
    {"mass_40", "kg", "mass of link 40", NAN, 0.0, INFINITY, NAN},
    {"mass_41", "kg", "mass of link 41", NAN, 0.0, INFINITY, NAN},
    {"mass_42", "kg", "mass of link 42", NAN, 0.0, INFINITY, NAN},
    {"mass_43", "kg", "mass of link 43", NAN, 0.0, INFINITY, NAN},
    {"mass_44", "kg", "mass of link 44", NAN, 0.0, INFINITY, NAN},
    {"mass_45", "kg", "mass of link 45", NAN, 0.0, INFINITY, NAN},
    {"mass_46", "kg", "mass of link 46", NAN, 0.0, INFINITY, NAN},
    {"mass_47", "kg", "mass of link 47", NAN, 0.0, INFINITY, NAN},
    {"mass_48", "kg", "mass of link 48", NAN, 0.0, INFINITY, NAN},
    {"mass_49", "kg", "mass of link 49", NAN, 0.0, INFINITY, NAN},
    {"mass_50", "kg", "mass of link 50", NAN, 0.0, INFINITY, NAN},
    {"mass_51", "kg", "mass of link 51", NAN, 0.0, INFINITY, NAN},
    {"mass_52", "kg", "mass of link 52", NAN, 0.0, INFINITY, NAN},
    {"mass_53", "kg", "mass of link 53", NAN, 0.0, INFINITY, NAN},
    {"mass_54", "kg", "mass of link 54", NAN, 0.0, INFINITY, NAN},
    {"mass_55", "kg", "mass of link 55", NAN, 0.0, INFINITY, NAN},
    {"mass_56", "kg", "mass of link 56", NAN, 0.0, INFINITY, NAN},
    {"mass_57", "kg", "mass of link 57", NAN, 0.0, INFINITY, NAN},
    {"mass_58", "kg", "mass of link 58", NAN, 0.0, INFINITY, NAN},
    {"mass_59", "kg", "mass of link 59", NAN, 0.0, INFINITY, NAN},
    {"mass_60", "kg", "mass of link 60", NAN, 0.0, INFINITY, NAN},
    {"inertia_1", "kg m^2", "rotational inertia about its own centre of link 1", NAN, 0.0, INFINITY, NAN},
    {"inertia_2", "kg m^2", "rotational inertia about its own centre of link 2", NAN, 0.0, INFINITY, NAN},
    {"inertia_3", "kg m^2", "rotational inertia about its own centre of link 3", NAN, 0.0, INFINITY, NAN},
    {"inertia_4", "kg m^2", "rotational inertia about its own centre of link 4", NAN, 0.0, INFINITY, NAN},
    {"inertia_5", "kg m^2", "rotational inertia about its own centre of link 5", NAN, 0.0, INFINITY, NAN},
    {"inertia_6", "kg m^2", "rotational inertia about its own centre of link 6", NAN, 0.0, INFINITY, NAN},
    {"inertia_7", "kg m^2", "rotational inertia about its own centre of link 7", NAN, 0.0, INFINITY, NAN},
    {"inertia_8", "kg m^2", "rotational inertia about its own centre of link 8", NAN, 0.0, INFINITY, NAN},
    {"inertia_9", "kg m^2", "rotational inertia about its own centre of link 9", NAN, 0.0, INFINITY, NAN},
    {"inertia_10", "kg m^2", "rotational inertia about its own centre of link 10", NAN, 0.0, INFINITY, NAN},
    {"inertia_11", "kg m^2", "rotational inertia about its own centre of link 11", NAN, 0.0, INFINITY, NAN},
    {"inertia_12", "kg m^2", "rotational inertia about its own centre of link 12", NAN, 0.0, INFINITY, NAN},
    {"inertia_13", "kg m^2", "rotational inertia about its own centre of link 13", NAN, 0.0, INFINITY, NAN},
    {"inertia_14", "kg m^2", "rotational inertia about its own centre of link 14", NAN, 0.0, INFINITY, NAN},
    {"inertia_15", "kg m^2", "rotational inertia about its own centre of link 15", NAN, 0.0, INFINITY, NAN},
    {"inertia_16", "kg m^2", "rotational inertia about its own centre of link 16", NAN, 0.0, INFINITY, NAN},
    {"inertia_17", "kg m^2", "rotational inertia about its own centre of link 17", NAN, 0.0, INFINITY, NAN},
    {"inertia_18", "kg m^2", "rotational inertia about its own centre of link 18", NAN, 0.0, INFINITY, NAN},
    {"inertia_19", "kg m^2", "rotational inertia about its own centre of link 19", NAN, 0.0, INFINITY, NAN},
    {"inertia_20", "kg m^2", "rotational inertia about its own centre of link 20", NAN, 0.0, INFINITY, NAN},
    {"inertia_21", "kg m^2", "rotational inertia about its own centre of link 21", NAN, 0.0, INFINITY, NAN},
    {"inertia_22", "kg m^2", "rotational inertia about its own centre of link 22", NAN, 0.0, INFINITY, NAN},
    {"inertia_23", "kg m^2", "rotational inertia about its own centre of link 23", NAN, 0.0, INFINITY, NAN},
    {"inertia_24", "kg m^2", "rotational inertia about its own centre of link 24", NAN, 0.0, INFINITY, NAN},
    {"inertia_25", "kg m^2", "rotational inertia about its own centre of link 25", NAN, 0.0, INFINITY, NAN},
    {"inertia_26", "kg m^2", "rotational inertia about its own centre of link 26", NAN, 0.0, INFINITY, NAN},
    {"inertia_27", "kg m^2", "rotational inertia about its own centre of link 27", NAN, 0.0, INFINITY, NAN},
    {"inertia_28", "kg m^2", "rotational inertia about its own centre of link 28", NAN, 0.0, INFINITY, NAN},
    {"inertia_29", "kg m^2", "rotational inertia about its own centre of link 29", NAN, 0.0, INFINITY, NAN},
    {"inertia_30", "kg m^2", "rotational inertia about its own centre of link 30", NAN, 0.0, INFINITY, NAN},
    {"inertia_31", "kg m^2", "rotational inertia about its own centre of link 31", NAN, 0.0, INFINITY, NAN},
    {"inertia_32", "kg m^2", "rotational inertia about its own centre of link 32", NAN, 0.0, INFINITY, NAN},
    {"inertia_33", "kg m^2", "rotational inertia about its own centre of link 33", NAN, 0.0, INFINITY, NAN},
    {"inertia_34", "kg m^2", "rotational inertia about its own centre of link 34", NAN, 0.0, INFINITY, NAN},
    {"inertia_35", "kg m^2", "rotational inertia about its own centre of link 35", NAN, 0.0, INFINITY, NAN},
    {"inertia_36", "kg m^2", "rotational inertia about its own centre of link 36", NAN, 0.0, INFINITY, NAN},
    {"inertia_37", "kg m^2", "rotational inertia about its own centre of link 37", NAN, 0.0, INFINITY, NAN},
    {"inertia_38", "kg m^2", "rotational inertia about its own centre of link 38", NAN, 0.0, INFINITY, NAN},
    {"inertia_39", "kg m^2", "rotational inertia about its own centre of link 39", NAN, 0.0, INFINITY, NAN},
    {"inertia_40", "kg m^2", "rotational inertia about its own centre of link 40", NAN, 0.0, INFINITY, NAN},
    {"inertia_41", "kg m^2", "rotational inertia about its own centre of link 41", NAN, 0.0, INFINITY, NAN},
    {"inertia_42", "kg m^2", "rotational inertia about its own centre of link 42", NAN, 0.0, INFINITY, NAN},
    {"inertia_43", "kg m^2", "rotational inertia about its own centre of link 43", NAN, 0.0, INFINITY, NAN},
    {"inertia_44", "kg m^2", "rotational inertia about its own centre of link 44", NAN, 0.0, INFINITY, NAN},
    {"inertia_45", "kg m^2", "rotational inertia about its own centre of link 45", NAN, 0.0, INFINITY, NAN},
    {"inertia_46", "kg m^2", "rotational inertia about its own centre of link 46", NAN, 0.0, INFINITY, NAN},
    {"inertia_47", "kg m^2", "rotational inertia about its own centre of link 47", NAN, 0.0, INFINITY, NAN},
    {"inertia_48", "kg m^2", "rotational inertia about its own centre of link 48", NAN, 0.0, INFINITY, NAN},
    {"inertia_49", "kg m^2", "rotational inertia about its own centre of link 49", NAN, 0.0, INFINITY, NAN},
    {"inertia_50", "kg m^2", "rotational inertia about its own centre of link 50", NAN, 0.0, INFINITY, NAN},
    {"inertia_51", "kg m^2", "rotational inertia about its own centre of link 51", NAN, 0.0, INFINITY, NAN},
    {"inertia_52", "kg m^2", "rotational inertia about its own centre of link 52", NAN, 0.0, INFINITY, NAN},
    {"inertia_53", "kg m^2", "rotational inertia about its own centre of link 53", NAN, 0.0, INFINITY, NAN},
    {"inertia_54", "kg m^2", "rotational inertia about its own centre of link 54", NAN, 0.0, INFINITY, NAN},
    {"inertia_55", "kg m^2", "rotational inertia about its own centre of link 55", NAN, 0.0, INFINITY, NAN},
    {"inertia_56", "kg m^2", "rotational inertia about its own centre of link 56", NAN, 0.0, INFINITY, NAN},
    {"inertia_57", "kg m^2", "rotational inertia about its own centre of link 57", NAN, 0.0, INFINITY, NAN},
    {"inertia_58", "kg m^2", "rotational inertia about its own centre of link 58", NAN, 0.0, INFINITY, NAN},
    {"inertia_59", "kg m^2", "rotational inertia about its own centre of link 59", NAN, 0.0, INFINITY, NAN},
    {"inertia_60", "kg m^2", "rotational inertia about its own centre of link 60", NAN, 0.0, INFINITY, NAN},
    {"stiffness_1", "N m/rad", "stiffness of joint 1", NAN, 0.0, INFINITY, NAN},
    {"stiffness_2", "N m/rad", "stiffness of joint 2", NAN, 0.0, INFINITY, NAN},
    {"stiffness_3", "N m/rad", "stiffness of joint 3", NAN, 0.0, INFINITY, NAN},
    {"stiffness_4", "N m/rad", "stiffness of joint 4", NAN, 0.0, INFINITY, NAN},
    {"stiffness_5", "N m/rad", "stiffness of joint 5", NAN, 0.0, INFINITY, NAN},
    {"stiffness_6", "N m/rad", "stiffness of joint 6", NAN, 0.0, INFINITY, NAN},
    {"stiffness_7", "N m/rad", "stiffness of joint 7", NAN, 0.0, INFINITY, NAN},
    {"stiffness_8", "N m/rad", "stiffness of joint 8", NAN, 0.0, INFINITY, NAN},
    {"stiffness_9", "N m/rad", "stiffness of joint 9", NAN, 0.0, INFINITY, NAN},
    {"stiffness_10", "N m/rad", "stiffness of joint 10", NAN, 0.0, INFINITY, NAN},
    {"stiffness_11", "N m/rad", "stiffness of joint 11", NAN, 0.0, INFINITY, NAN},
    {"stiffness_12", "N m/rad", "stiffness of joint 12", NAN, 0.0, INFINITY, NAN},
    {"stiffness_13", "N m/rad", "stiffness of joint 13", NAN, 0.0, INFINITY, NAN},
    {"stiffness_14", "N m/rad", "stiffness of joint 14", NAN, 0.0, INFINITY, NAN},
    {"stiffness_15", "N m/rad", "stiffness of joint 15", NAN, 0.0, INFINITY, NAN},
    {"stiffness_16", "N m/rad", "stiffness of joint 16", NAN, 0.0, INFINITY, NAN},
    {"stiffness_17", "N m/rad", "stiffness of joint 17", NAN, 0.0, INFINITY, NAN},
    {"stiffness_18", "N m/rad", "stiffness of joint 18", NAN, 0.0, INFINITY, NAN},
    {"stiffness_19", "N m/rad", "stiffness of joint 19", NAN, 0.0, INFINITY, NAN},
    {"stiffness_20", "N m/rad", "stiffness of joint 20", NAN, 0.0, INFINITY, NAN},
    {"stiffness_21", "N m/rad", "stiffness of joint 21", NAN, 0.0, INFINITY, NAN},
    {"stiffness_22", "N m/rad", "stiffness of joint 22", NAN, 0.0, INFINITY, NAN},
    {"stiffness_23", "N m/rad", "stiffness of joint 23", NAN, 0.0, INFINITY, NAN},
    {"stiffness_24", "N m/rad", "stiffness of joint 24", NAN, 0.0, INFINITY, NAN},
    {"stiffness_25", "N m/rad", "stiffness of joint 25", NAN, 0.0, INFINITY, NAN},
    {"stiffness_26", "N m/rad", "stiffness of joint 26", NAN, 0.0, INFINITY, NAN},
    {"stiffness_27", "N m/rad", "stiffness of joint 27", NAN, 0.0, INFINITY, NAN},
    {"stiffness_28", "N m/rad", "stiffness of joint 28", NAN, 0.0, INFINITY, NAN},
    {"stiffness_29", "N m/rad", "stiffness of joint 29", NAN, 0.0, INFINITY, NAN},
    {"stiffness_30", "N m/rad", "stiffness of joint 30", NAN, 0.0, INFINITY, NAN},
    {"stiffness_31", "N m/rad", "stiffness of joint 31", NAN, 0.0, INFINITY, NAN},
    {"stiffness_32", "N m/rad", "stiffness of joint 32", NAN, 0.0, INFINITY, NAN},
    {"stiffness_33", "N m/rad", "stiffness of joint 33", NAN, 0.0, INFINITY, NAN},
    {"stiffness_34", "N m/rad", "stiffness of joint 34", NAN, 0.0, INFINITY, NAN},
    {"stiffness_35", "N m/rad", "stiffness of joint 35", NAN, 0.0, INFINITY, NAN},
    {"stiffness_36", "N m/rad", "stiffness of joint 36", NAN, 0.0, INFINITY, NAN},
    {"stiffness_37", "N m/rad", "stiffness of joint 37", NAN, 0.0, INFINITY, NAN},
    {"stiffness_38", "N m/rad", "stiffness of joint 38", NAN, 0.0, INFINITY, NAN},
    {"stiffness_39", "N m/rad", "stiffness of joint 39", NAN, 0.0, INFINITY, NAN},
    {"stiffness_40", "N m/rad", "stiffness of joint 40", NAN, 0.0, INFINITY, NAN},
    {"stiffness_41", "N m/rad", "stiffness of joint 41", NAN, 0.0, INFINITY, NAN},
    {"stiffness_42", "N m/rad", "stiffness of joint 42", NAN, 0.0, INFINITY, NAN},
    {"stiffness_43", "N m/rad", "stiffness of joint 43", NAN, 0.0, INFINITY, NAN},
    {"stiffness_44", "N m/rad", "stiffness of joint 44", NAN, 0.0, INFINITY, NAN},
    {"stiffness_45", "N m/rad", "stiffness of joint 45", NAN, 0.0, INFINITY, NAN},
    {"stiffness_46", "N m/rad", "stiffness of joint 46", NAN, 0.0, INFINITY, NAN},
    {"stiffness_47", "N m/rad", "stiffness of joint 47", NAN, 0.0, INFINITY, NAN},
    {"stiffness_48", "N m/rad", "stiffness of joint 48", NAN, 0.0, INFINITY, NAN},
    {"stiffness_49", "N m/rad", "stiffness of joint 49", NAN, 0.0, INFINITY, NAN},
    {"stiffness_50", "N m/rad", "stiffness of joint 50", NAN, 0.0, INFINITY, NAN},
    {"stiffness_51", "N m/rad", "stiffness of joint 51", NAN, 0.0, INFINITY, NAN},
    {"stiffness_52", "N m/rad", "stiffness of joint 52", NAN, 0.0, INFINITY, NAN},
    {"stiffness_53", "N m/rad", "stiffness of joint 53", NAN, 0.0, INFINITY, NAN},
    {"stiffness_54", "N m/rad", "stiffness of joint 54", NAN, 0.0, INFINITY, NAN},
    {"stiffness_55", "N m/rad", "stiffness of joint 55", NAN, 0.0, INFINITY, NAN},
    {"stiffness_56", "N m/rad", "stiffness of joint 56", NAN, 0.0, INFINITY, NAN},
    {"stiffness_57", "N m/rad", "stiffness of joint 57", NAN, 0.0, INFINITY, NAN},
    {"stiffness_58", "N m/rad", "stiffness of joint 58", NAN, 0.0, INFINITY, NAN},
    {"stiffness_59", "N m/rad", "stiffness of joint 59", NAN, 0.0, INFINITY, NAN},
    {"stiffness_60", "N m/rad", "stiffness of joint 60", NAN, 0.0, INFINITY, NAN},
    {"damping_1", "N m s/rad", "damping of joint 1", NAN, 0.0, INFINITY, NAN},
    {"damping_2", "N m s/rad", "damping of joint 2", NAN, 0.0, INFINITY, NAN},
    {"damping_3", "N m s/rad", "damping of joint 3", NAN, 0.0, INFINITY, NAN},
    {"damping_4", "N m s/rad", "damping of joint 4", NAN, 0.0, INFINITY, NAN},
    {"damping_5", "N m s/rad", "damping of joint 5", NAN, 0.0, INFINITY, NAN},
    {"damping_6", "N m s/rad", "damping of joint 6", NAN, 0.0, INFINITY, NAN},
    {"damping_7", "N m s/rad", "damping of joint 7", NAN, 0.0, INFINITY, NAN},
    {"damping_8", "N m s/rad", "damping of joint 8", NAN, 0.0, INFINITY, NAN},
    {"damping_9", "N m s/rad", "damping of joint 9", NAN, 0.0, INFINITY, NAN},
    {"damping_10", "N m s/rad", "damping of joint 10", NAN, 0.0, INFINITY, NAN},
    {"damping_11", "N m s/rad", "damping of joint 11", NAN, 0.0, INFINITY, NAN},
    {"damping_12", "N m s/rad", "damping of joint 12", NAN, 0.0, INFINITY, NAN},
    {"damping_13", "N m s/rad", "damping of joint 13", NAN, 0.0, INFINITY, NAN},
    {"damping_14", "N m s/rad", "damping of joint 14", NAN, 0.0, INFINITY, NAN},
    {"damping_15", "N m s/rad", "damping of joint 15", NAN, 0.0, INFINITY, NAN},
    {"damping_16", "N m s/rad", "damping of joint 16", NAN, 0.0, INFINITY, NAN},
    {"damping_17", "N m s/rad", "damping of joint 17", NAN, 0.0, INFINITY, NAN},
    {"damping_18", "N m s/rad", "damping of joint 18", NAN, 0.0, INFINITY, NAN},
    {"damping_19", "N m s/rad", "damping of joint 19", NAN, 0.0, INFINITY, NAN},
    {"damping_20", "N m s/rad", "damping of joint 20", NAN, 0.0, INFINITY, NAN},
    {"damping_21", "N m s/rad", "damping of joint 21", NAN, 0.0, INFINITY, NAN},
    {"damping_22", "N m s/rad", "damping of joint 22", NAN, 0.0, INFINITY, NAN},
    {"damping_23", "N m s/rad", "damping of joint 23", NAN, 0.0, INFINITY, NAN},
    {"damping_24", "N m s/rad", "damping of joint 24", NAN, 0.0, INFINITY, NAN},
    {"damping_25", "N m s/rad", "damping of joint 25", NAN, 0.0, INFINITY, NAN},
    {"damping_26", "N m s/rad", "damping of joint 26", NAN, 0.0, INFINITY, NAN},
    {"damping_27", "N m s/rad", "damping of joint 27", NAN, 0.0, INFINITY, NAN},
    {"damping_28", "N m s/rad", "damping of joint 28", NAN, 0.0, INFINITY, NAN},
    {"damping_29", "N m s/rad", "damping of joint 29", NAN, 0.0, INFINITY, NAN},
    {"damping_30", "N m s/rad", "damping of joint 30", NAN, 0.0, INFINITY, NAN},
    {"damping_31", "N m s/rad", "damping of joint 31", NAN, 0.0, INFINITY, NAN},
    {"damping_32", "N m s/rad", "damping of joint 32", NAN, 0.0, INFINITY, NAN},
    {"damping_33", "N m s/rad", "damping of joint 33", NAN, 0.0, INFINITY, NAN},
    {"damping_34", "N m s/rad", "damping of joint 34", NAN, 0.0, INFINITY, NAN},
    {"damping_35", "N m s/rad", "damping of joint 35", NAN, 0.0, INFINITY, NAN},
    {"damping_36", "N m s/rad", "damping of joint 36", NAN, 0.0, INFINITY, NAN},
    {"damping_37", "N m s/rad", "damping of joint 37", NAN, 0.0, INFINITY, NAN},
    {"damping_38", "N m s/rad", "damping of joint 38", NAN, 0.0, INFINITY, NAN},
    {"damping_39", "N m s/rad", "damping of joint 39", NAN, 0.0, INFINITY, NAN},
    {"damping_40", "N m s/rad", "damping of joint 40", NAN, 0.0, INFINITY, NAN},
    {"damping_41", "N m s/rad", "damping of joint 41", NAN, 0.0, INFINITY, NAN},
    {"damping_42", "N m s/rad", "damping of joint 42", NAN, 0.0, INFINITY, NAN},
    {"damping_43", "N m s/rad", "damping of joint 43", NAN, 0.0, INFINITY, NAN},
    {"damping_44", "N m s/rad", "damping of joint 44", NAN, 0.0, INFINITY, NAN},
    {"damping_45", "N m s/rad", "damping of joint 45", NAN, 0.0, INFINITY, NAN},
    {"damping_46", "N m s/rad", "damping of joint 46", NAN, 0.0, INFINITY, NAN},
    {"damping_47", "N m s/rad", "damping of joint 47", NAN, 0.0, INFINITY, NAN},
    {"damping_48", "N m s/rad", "damping of joint 48", NAN, 0.0, INFINITY, NAN},
    {"damping_49", "N m s/rad", "damping of joint 49", NAN, 0.0, INFINITY, NAN},
    {"damping_50", "N m s/rad", "damping of joint 50", NAN, 0.0, INFINITY, NAN},
    {"damping_51", "N m s/rad", "damping of joint 51", NAN, 0.0, INFINITY, NAN},
    {"damping_52", "N m s/rad", "damping of joint 52", NAN, 0.0, INFINITY, NAN},
    {"damping_53", "N m s/rad", "damping of joint 53", NAN, 0.0, INFINITY, NAN},
    {"damping_54", "N m s/rad", "damping of joint 54", NAN, 0.0, INFINITY, NAN},
    {"damping_55", "N m s/rad", "damping of joint 55", NAN, 0.0, INFINITY, NAN},
    {"damping_56", "N m s/rad", "damping of joint 56", NAN, 0.0, INFINITY, NAN},
    {"damping_57", "N m s/rad", "damping of joint 57", NAN, 0.0, INFINITY, NAN},
    {"damping_58", "N m s/rad", "damping of joint 58", NAN, 0.0, INFINITY, NAN},
    {"damping_59", "N m s/rad", "damping of joint 59", NAN, 0.0, INFINITY, NAN},
    {"damping_60", "N m s/rad", "damping of joint 60", NAN, 0.0, INFINITY, NAN},
    {"torque_1", "N m", "external torque on the angle of link 1", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_2", "N m", "external torque on the angle of link 2", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_3", "N m", "external torque on the angle of link 3", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_4", "N m", "external torque on the angle of link 4", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_5", "N m", "external torque on the angle of link 5", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_6", "N m", "external torque on the angle of link 6", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_7", "N m", "external torque on the angle of link 7", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_8", "N m", "external torque on the angle of link 8", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_9", "N m", "external torque on the angle of link 9", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_10", "N m", "external torque on the angle of link 10", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_11", "N m", "external torque on the angle of link 11", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_12", "N m", "external torque on the angle of link 12", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_13", "N m", "external torque on the angle of link 13", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_14", "N m", "external torque on the angle of link 14", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_15", "N m", "external torque on the angle of link 15", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_16", "N m", "external torque on the angle of link 16", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_17", "N m", "external torque on the angle of link 17", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_18", "N m", "external torque on the angle of link 18", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_19", "N m", "external torque on the angle of link 19", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_20", "N m", "external torque on the angle of link 20", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_21", "N m", "external torque on the angle of link 21", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_22", "N m", "external torque on the angle of link 22", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_23", "N m", "external torque on the angle of link 23", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_24", "N m", "external torque on the angle of link 24", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_25", "N m", "external torque on the angle of link 25", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_26", "N m", "external torque on the angle of link 26", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_27", "N m", "external torque on the angle of link 27", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_28", "N m", "external torque on the angle of link 28", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_29", "N m", "external torque on the angle of link 29", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_30", "N m", "external torque on the angle of link 30", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_31", "N m", "external torque on the angle of link 31", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_32", "N m", "external torque on the angle of link 32", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_33", "N m", "external torque on the angle of link 33", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_34", "N m", "external torque on the angle of link 34", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_35", "N m", "external torque on the angle of link 35", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_36", "N m", "external torque on the angle of link 36", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_37", "N m", "external torque on the angle of link 37", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_38", "N m", "external torque on the angle of link 38", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_39", "N m", "external torque on the angle of link 39", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_40", "N m", "external torque on the angle of link 40", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_41", "N m", "external torque on the angle of link 41", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_42", "N m", "external torque on the angle of link 42", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_43", "N m", "external torque on the angle of link 43", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_44", "N m", "external torque on the angle of link 44", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_45", "N m", "external torque on the angle of link 45", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_46", "N m", "external torque on the angle of link 46", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_47", "N m", "external torque on the angle of link 47", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_48", "N m", "external torque on the angle of link 48", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_49", "N m", "external torque on the angle of link 49", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_50", "N m", "external torque on the angle of link 50", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_51", "N m", "external torque on the angle of link 51", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_52", "N m", "external torque on the angle of link 52", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_53", "N m", "external torque on the angle of link 53", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_54", "N m", "external torque on the angle of link 54", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_55", "N m", "external torque on the angle of link 55", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_56", "N m", "external torque on the angle of link 56", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_57", "N m", "external torque on the angle of link 57", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_58", "N m", "external torque on the angle of link 58", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_59", "N m", "external torque on the angle of link 59", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_60", "N m", "external torque on the angle of link 60", 0.0, -INFINITY, INFINITY, NAN},
    {"load_mass", "kg", "mass of the load at the free end", NAN, 0.0, INFINITY, NAN},
    {"gravity", "m/s^2", "acceleration of gravity", 9.8100000000000005, -INFINITY, INFINITY, NAN},
};

static const catena_energy kEnergyTable[] = {
    {"kinetic", CATENA_STORED},
    {"gravity", CATENA_STORED},
    {"joint_elastic", CATENA_STORED},
    {"joint_damping", CATENA_DISSIPATED},
    {"torque", CATENA_SUPPLIED},
};

#if !defined(__GNUC__) || defined(__clang__) || defined(__SANITIZE_ADDRESS__)
#define CATENA_EACH_PROCESSOR
#elif defined(__x86_64__) && !(defined(__AVX2__) && defined(__FMA__))
// Compiled twice, for processors with AVX2 and fused multiply-add too; the bits are the same.
#define CATENA_PROCESSORS
#define CATENA_EACH_PROCESSOR \
  __attribute__((target_clones("arch=x86-64-v3", "default"), flatten))
#else
#define CATENA_EACH_PROCESSOR __attribute__((flatten))
#endif

Point<double> point(const catena_point* p) {
  return {p->t, p->q, p->v, p->a, p->z, p->u, p->p};
}

CATENA_EACH_PROCESSOR
void c_residual(const void*, const catena_point* at, double* r) {
  residual(point(at), r);
}
CATENA_EACH_PROCESSOR
void c_residual_tangent(const void*, const catena_point* at, const catena_point* along,
                        double* dr) {
  residual_tangent(point(at), point(along), dr);
}
CATENA_EACH_PROCESSOR
void c_residual_tangents(const void*, const catena_point* at, const catena_point* along,
                         double* dr) {
  residual_tangent(point(at), directions(along), directions(dr));
}
CATENA_EACH_PROCESSOR
void c_residual_term(const void*, const catena_point* at, int32_t term, double* r) {
  residual_term(point(at), term, r);
}
CATENA_EACH_PROCESSOR
void c_bias(const void*, const catena_point* at, double* h) {
  bias(point(at), h);
}
CATENA_EACH_PROCESSOR
void c_mass_matrix(const void*, const catena_point* at, double* M) {
  mass_matrix(point(at), M);
}
CATENA_EACH_PROCESSOR
int32_t c_acceleration(const void*, const catena_point* at, double* a) {
  return acceleration(point(at), a);
}
CATENA_EACH_PROCESSOR
void c_energy(const void*, const catena_point* at, double* e) {
  energy(point(at), e);
}
CATENA_EACH_PROCESSOR
void c_positions(const void*, const catena_point* at, double* side, double* down) {
  positions(point(at), side, down);
}
CATENA_EACH_PROCESSOR
void c_positions_tangent(const void*, const catena_point* at, const catena_point* along,
                         double* dside, double* ddown) {
  positions_tangent(point(at), point(along), dside, ddown);
}
CATENA_EACH_PROCESSOR
void c_velocities(const void*, const catena_point* at, double* side_rate, double* down_rate) {
  velocities(point(at), side_rate, down_rate);
}
CATENA_EACH_PROCESSOR
void c_internal_forces(const void*, const catena_point* at, double* moment, double* tension,
                       double* curvature) {
  internal_forces(point(at), moment, tension, curvature);
}
CATENA_EACH_PROCESSOR
void c_reactions(const void*, const catena_point* at, double* force, double* moment) {
  reactions(point(at), force, moment);
}
CATENA_EACH_PROCESSOR
void c_residual_adjoint(const void*, const catena_point* at, const double* weights,
                        const double* rate_weights, double* dq, double* dv, double* dz,
                        double* dp) {
  residual_adjoint(point(at), weights, rate_weights, dq, dv, dz, dp);
}
NewtonMatrix<double>& matrix_in(double* work) {
  return *reinterpret_cast<NewtonMatrix<double>*>(work);
}
const NewtonMatrix<double>& factored(const double* work) {
  return matrix_in(const_cast<double*>(work));  // solving only reads
}
CATENA_EACH_PROCESSOR
int32_t c_newton_factor(const void*, const catena_point* at, double ca, double cv, double cq,
                        double* __restrict work) {
  auto&& matrix = matrix_in(work);
  newton_matrix(point(at), ca, cv, cq, matrix);
  return matrix.factor();
}
CATENA_EACH_PROCESSOR
void c_newton_solve(const void*, const double* work, double* x) {
  factored(work).solve(x);
}
CATENA_EACH_PROCESSOR
void c_newton_solves(const void*, const double* work, double* x) {
  factored(work).solve(directions(x));
}
CATENA_EACH_PROCESSOR
void c_newton_solve_transposed(const void*, const double* work, double* x) {
  factored(work).solve_transposed(x);
}
template <int size>
int32_t batch_of(const catena_point* at, double* a) {
  using Number = Batch<size>;
  const auto numbers = [](const double* first) {
    return reinterpret_cast<const Number*>(first);
  };
  const Point<Number> points{Number(at->t),  numbers(at->q), numbers(at->v), numbers(at->a),
                             numbers(at->z), numbers(at->u), numbers(at->p)};
  return accelerations(points, reinterpret_cast<Number*>(a));
}
#ifdef CATENA_PROCESSORS
__attribute__((target("arch=x86-64-v4"), flatten))
int32_t eight(const catena_point* at, double* a) {
  return batch_of<8>(at, a);
}
__attribute__((target("arch=x86-64-v3"), flatten))
int32_t four(const catena_point* at, double* a) {
  return batch_of<4>(at, a);
}
int32_t batch_size() {
  return __builtin_cpu_supports("x86-64-v4")   ? 8
         : __builtin_cpu_supports("x86-64-v3") ? 4
                                                 : 2;
}
int32_t c_accelerations(const void*, const catena_point* at, double* a) {
  static const int32_t batch = batch_size();
  return batch == 8 ? eight(at, a) : batch == 4 ? four(at, a) : batch_of<2>(at, a);
}
#elif defined(__GNUC__)
#if defined(__AVX512F__)
static constexpr int kBatch = 8;
#elif defined(__AVX2__)
static constexpr int kBatch = 4;
#else
static constexpr int kBatch = 2;
#endif
int32_t batch_size() { return kBatch; }
CATENA_EACH_PROCESSOR
int32_t c_accelerations(const void*, const catena_point* at, double* a) {
  return batch_of<kBatch>(at, a);
}
#else
int32_t batch_size() { return 1; }
int32_t c_accelerations(const void* context, const catena_point* at, double* a) {
  return c_acceleration(context, at, a);
}
#endif
}  // namespace

const ::catena_model& table() {
  static const ::catena_model model = {
      CATENA_MODEL_ABI,
      sizeof(::catena_model),
      "chain_60",
      "fa7041eb0fff7d62b7a0a54413cc5a263a87087073ced168df3a0024accbbce8",
      nullptr,  // context
      kLinks,
      kCoordinates,
      kStates,
      kSignals,
      kParameters,
      6,  // terms
      5,  // energies
      0,  // observes
      1,  // structured
      sizeof(NewtonMatrix<double>) / sizeof(double),
      batch_size(),  // batch
      kCoordinateTable,
      kStateTable,
      kSignalTable,
      kParameterTable,
      kTermTable,
      kEnergyTable,
      c_residual,
      c_residual_tangent,
      c_residual_tangents,
      c_residual_adjoint,
      c_residual_term,
      nullptr,
      nullptr,
      nullptr,
      c_mass_matrix,
      c_bias,
      c_acceleration,
      c_accelerations,
      c_newton_factor,
      c_newton_solve,
      c_newton_solves,
      c_newton_solve_transposed,
      c_energy,
      c_positions,
      c_positions_tangent,
      c_velocities,
      c_internal_forces,
      nullptr,
      nullptr,
      nullptr,
      nullptr,
      nullptr,
      nullptr,
      nullptr,
      c_reactions,
      nullptr,
      nullptr,
      0,  // events
      nullptr,
  };
  return model;
}

}  // namespace catena::chain_60

#ifdef CATENA_SHARED_LIBRARY
// The one entry of a shared library that holds this model alone.
extern "C" const catena_model* catena_model_table() {
  return &catena::chain_60::table();
}
#endif
