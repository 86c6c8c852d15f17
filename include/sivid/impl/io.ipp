// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_IO_IPP
#define SIVID_IMPL_IO_IPP

#include <sivid/io/dataset/impl/dataset_digest.ipp>
#include <sivid/io/impl/allowed_disturbances.ipp>
#include <sivid/io/impl/checkpoint_reader.ipp>
#include <sivid/io/impl/dataset.ipp>
#include <sivid/io/impl/decision_json.ipp>
#include <sivid/io/impl/diagnosis_json.ipp>
#include <sivid/io/impl/diagnosis_reader.ipp>
#include <sivid/io/impl/explaining_motion.ipp>
#include <sivid/io/impl/identification_csv.ipp>
#include <sivid/io/impl/identification_json.ipp>
#include <sivid/io/impl/identification_reader.ipp>
#include <sivid/io/impl/problem_from_dataset.ipp>
#include <sivid/io/impl/scenario.ipp>
#include <sivid/io/result/impl/certificates_csv.ipp>
#include <sivid/io/result/impl/problem_digest.ipp>
#include <sivid/io/result/impl/same_problem.ipp>
#include <sivid/io/simulator/impl/export_mapping.ipp>
#include <sivid/io/simulator/impl/robot_file.ipp>
#include <sivid/io/text/impl/exact_decimal.ipp>
#include <sivid/io/text/impl/json_document.ipp>

#endif
